// Feet and rows of points at a pose.

#include <gtest/gtest.h>

#include <numeric>

#include "tests/support/localizer_fixtures.hpp"
#include "tests/unit/core/owned_parts.hpp"

namespace bladefit::testing {
namespace {

const Vec6 kAway = (Vec6() << 0.3, -0.2, 0.1, 0.5, 0.2, -0.4).finished();

std::vector<ProbePoint> some_points(std::size_t count) {
  std::vector<ProbePoint> points = points_of(read_case("dtmb4119"), "full");
  std::vector<ProbePoint> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(points[i * points.size() / count]);
  return out;
}

/// Stored points, and a pose a little off the one their feet were found at.
struct Found {
  explicit Found(std::size_t count)
      : parts(reference_design("dtmb4119").image(), config_of(read_case("dtmb4119"), 200)) {
    parts.store(some_points(count));
    pose = moved(parts->estimate.pose(), 1e-3 * kAway, parts->problem.frame);
  }
  OwnedParts parts;
  Pose pose;
};

void expect_same(const Measurement& one, const Measurement& other) {
  EXPECT_EQ(one.r, other.r);
  EXPECT_EQ(one.foot.patch, other.foot.patch);
  EXPECT_EQ(one.foot.u, other.foot.u);
  EXPECT_EQ(one.foot.v, other.foot.v);
  EXPECT_EQ(one.foot.point, other.foot.point);
  EXPECT_EQ(one.foot.normal, other.foot.normal);
  EXPECT_EQ(one.foot.distance, other.foot.distance);
  EXPECT_EQ(one.foot.kind, other.foot.kind);
  EXPECT_EQ(one.place.span, other.place.span);
  EXPECT_EQ(one.searched, other.searched);
  EXPECT_EQ(one.changed, other.changed);
  EXPECT_EQ(one.ranked, other.ranked);
  EXPECT_EQ(one.runner_up.margin, other.runner_up.margin);
  EXPECT_EQ(one.proven, other.proven);
}

TEST(FootFinder, FindsPointsTogetherToTheBitsOfEachAlone) {
  Found found(90);
  const FootFinder& finder = found.parts->finder;
  std::uint32_t first = 0;
  for (std::uint32_t count = 0; count <= 9; ++count) {
    for (const Search search : {Search::if_doubtful, Search::past_margin, Search::keep, Search::always}) {
      std::vector<std::uint32_t> indices(count), order;
      std::iota(indices.rbegin(), indices.rend(), first);  // not as they are stored
      finder.find_each(
          found.parts->store, indices, found.pose, kAway,
          [&](std::uint32_t index) {
            return FootStart{place_of(found.parts->store[index]), search};
          },
          [&](std::uint32_t index, const Measurement& m) {
            order.push_back(index);
            const Measurement alone = finder.find(found.parts->store[index], found.pose, search);
            expect_same(m, alone);
            const DistanceRow row = finder.row(m, kAway), wanted = finder.row(alone, kAway);
            EXPECT_EQ(row.distance, wanted.distance);
            EXPECT_EQ(row.gradient, wanted.gradient);
            EXPECT_EQ(row.bend, wanted.bend);
          });
      EXPECT_EQ(order, indices);
    }
    first += count;
  }
}

TEST(FootFinder, AsksOfEachPointHowItIsToBeSought) {
  Found found(9);
  const std::vector<std::uint32_t> indices = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  const auto odd = [&](std::uint32_t index) {
    const StoredPoint& p = found.parts->store[index];
    return FootStart{place_of(p), p.sequence % 2 == 1 ? Search::always : Search::if_doubtful};
  };
  for (std::uint32_t i = 0; i < 9; ++i) found.parts->store[i].sequence = i + 1;
  found.parts->finder.find_each(
      found.parts->store, indices, found.pose, kAway, odd,
      [&](std::uint32_t index, const Measurement& m) { EXPECT_EQ(m.ranked, index % 2 == 0) << index; });
}

TEST(FootFinder, ChangesNothing) {
  Found found(9);
  const StoredPoint before = found.parts->store[4];
  const std::uint32_t searches = found.parts->store.searches();
  (void)found.parts->finder.find(before, found.pose, Search::always);
  EXPECT_EQ(found.parts->store[4].foot.u, before.foot.u);
  EXPECT_EQ(found.parts->store.searches(), searches);
}

TEST(FootFinder, ProvesPastTheMarginAndNotWithinIt) {
  Found found(90);
  const double moved_by = 1e-4 * found.parts->problem.frame.length;
  Pose pose = found.parts->estimate.pose();
  pose.translation.x() += moved_by;
  std::uint32_t looked = 0, searched = 0;
  for (std::uint32_t i = 0; i < found.parts->store.size(); ++i) {
    StoredPoint point = found.parts->store[i];
    if (found.parts->finder.find(point, pose, Search::if_doubtful).searched) continue;
    ++looked;
    point.runner_up.margin_to_third = 0.0;
    point.runner_up.margin = 2.001 * moved_by;
    EXPECT_FALSE(found.parts->finder.find(point, pose, Search::past_margin).ranked) << i;
    point.runner_up.margin = 1.999 * moved_by;
    const Measurement m = found.parts->finder.find(point, pose, Search::past_margin);
    EXPECT_TRUE(m.ranked) << i;
    if (m.searched) ++searched;
    EXPECT_FALSE(found.parts->finder.find(point, pose, Search::if_doubtful).searched) << i;
  }
  EXPECT_GT(looked, 60U);
  EXPECT_LT(searched, looked / 2) << "most are told by their reach";
}

TEST(FootFinder, MakesAPointThatIsSoughtFromAPlace) {
  LocalizerConfig config = config_of(read_case("dtmb4119"), 10);
  ProbePoint probe = some_points(1)[0];
  probe.sequence = 77;
  probe.weight = 2.5;
  for (const bool use : {true, false}) {
    config.use_approach = use;
    const FitProblem problem(reference_design("dtmb4119").image(), config);
    const StoredPoint made = FootFinder(problem).new_point(probe, {3, 0.25, 0.75});
    EXPECT_EQ(made.sequence, 77U);
    EXPECT_EQ(made.weight, 2.5);
    EXPECT_EQ(made.position, Vec3(probe.position.data()));
    EXPECT_EQ(made.approach, use ? Vec3(probe.approach.data()) : Vec3(Vec3::Zero()));
    EXPECT_EQ(made.span, 3U);
    EXPECT_EQ(made.foot.u, 0.25);
    EXPECT_EQ(made.foot.v, 0.75);
    EXPECT_FALSE(made.outside_window);
  }
}

TEST(FootFinder, KnowsThePointsWhoseFootAtTheStartIsOutsideTheWindow) {
  LocalizerConfig config = config_of(read_case("dtmb4119"), 10);
  const FitProblem whole(reference_design("dtmb4119").image(), config);
  config.window_low = 0.2;
  config.window_high = 0.8;
  const FitProblem windowed(reference_design("dtmb4119").image(), config);
  std::array<int, 2> seen{};
  for (const ProbePoint& probe : some_points(60)) {
    const StoredPoint made = FootFinder(windowed).new_point(probe, {});
    const Foot foot = FootFinder(whole).find(made, config.start, Search::always).foot;
    const auto outside = [](double t) { return t < 0.2 || t > 0.8; };
    EXPECT_EQ(made.outside_window, outside(foot.u) || outside(foot.v));
    EXPECT_FALSE(FootFinder(whole).new_point(probe, {}).outside_window);
    ++seen[made.outside_window ? 1 : 0];
  }
  EXPECT_GT(seen[0], 5);
  EXPECT_GT(seen[1], 5);
}

}  // namespace
}  // namespace bladefit::testing
