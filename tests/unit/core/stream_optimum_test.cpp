// A mode's optimum followed point by point.

#include <gtest/gtest.h>

#include "tests/support/localizer_fixtures.hpp"
#include "tests/unit/core/owned_parts.hpp"

namespace bladefit::testing {
namespace {

LocalizerConfig followed_config(FitMode mode, double tolerance) {
  LocalizerConfig config = config_of(read_case("dtmb4119"), 100);
  config.mode = mode;
  config.tolerance.leading_edge_mm = tolerance;
  config.tolerance.rest_mm = 10 * tolerance;
  return config;
}

/// Stored points at their least-squares optimum, and what is followed from there.
struct Followed {
  explicit Followed(FitMode mode = FitMode::minimax, double tolerance = 1.0)
      : parts(reference_design("dtmb4119").image(), followed_config(mode, tolerance)), part(parts->stream_optimum) {
    parts.store(thinned(read_case("dtmb4119"), 0, 25));
    parts.fit();
  }

  void follow() { follow(parts->sums.model()); }
  void follow(const QuadraticModel& model) { part.follow(parts->store, model, parts->estimate, parts->optimum); }
  void look_at(std::uint32_t index) { part.look_at(parts->store, index, measured(index)); }
  [[nodiscard]] Measurement measured(std::uint32_t index) {
    return parts->finder.find(parts->store[index], part.pose(parts->optimum), Search::past_margin);
  }
  void follow_and_look() {
    follow();
    for (std::uint32_t i = 0; i < parts->store.size(); ++i) look_at(i);
  }
  /// Until every point has been looked at since the optimum moved.
  void settle() {
    for (int k = 0; k < 50 && part.improving(parts->store); ++k) follow_and_look();
    EXPECT_FALSE(part.improving(parts->store));
  }
  /// A point that counts and is not among those that the optimum is solved on.
  [[nodiscard]] std::uint32_t free_point() {
    std::uint32_t i = 0;
    while (part.holds(i) || parts->selection.left_out(parts->store[i], parts->store[i].foot)) ++i;
    return i;
  }

  OwnedParts parts;
  StreamOptimum& part;
};

TEST(StreamOptimum, BeginsOnlyWithEnoughPoints) {
  Followed followed;
  QuadraticModel model = followed.parts->sums.model();
  model.count = tuning::kLeastForProgram - 1;
  followed.follow(model);
  EXPECT_FALSE(followed.part.leads());
  EXPECT_EQ(followed.parts->optimum.value, 0.0);
  model.count = tuning::kLeastForProgram;
  followed.follow(model);
  EXPECT_TRUE(followed.part.leads());
}

TEST(StreamOptimum, BeginsOnlyAtAPoseThatIsDeterminedAndEndsWithThat) {
  Followed followed;
  Minimum open{};
  open.determination.rank = 5;
  followed.parts->estimate.know(open);
  followed.follow();
  EXPECT_FALSE(followed.part.leads());
  open.determination.rank = 6;
  followed.parts->estimate.know(open);
  followed.follow();
  EXPECT_TRUE(followed.part.leads());
  EXPECT_GT(followed.parts->optimum.value, 0.0);
  open.determination.rank = 5;
  followed.parts->estimate.know(open);
  followed.follow();
  EXPECT_FALSE(followed.part.leads());
  EXPECT_EQ(followed.parts->optimum.value, 0.0);
  EXPECT_EQ(followed.parts->optimum.certificate.count, 0U);
}

TEST(StreamOptimum, BeginsWithTheMostOutlyingPoints) {
  Followed followed;
  followed.part.begin(followed.parts->store, followed.parts->estimate.pose(), 1);
  double least_held = 1e9, most_free = 0.0;
  std::uint32_t held = 0;
  for (std::uint32_t i = 0; i < followed.parts->store.size(); ++i) {
    const StoredPoint& point = followed.parts->store[i];
    if (followed.parts->selection.left_out(point, point.foot)) {
      EXPECT_FALSE(followed.part.holds(i));
      continue;
    }
    const double size = std::abs(point.foot.distance);
    if (followed.part.holds(i)) {
      ++held;
      least_held = std::min(least_held, size);
    } else {
      most_free = std::max(most_free, size);
    }
  }
  EXPECT_EQ(held, BoundTracker::kPlaces);
  EXPECT_GE(least_held, most_free);
}

TEST(StreamOptimum, IsNotChangedByAPointThatFits) {
  Followed followed;
  followed.settle();
  const Pose pose = followed.part.pose(followed.parts->optimum);
  const double value = followed.parts->optimum.value;
  const std::uint32_t index = followed.free_point();
  ASSERT_LT(std::abs(followed.measured(index).foot.distance), value);
  followed.look_at(index);
  followed.follow();
  EXPECT_FALSE(followed.part.holds(index));
  EXPECT_FALSE(followed.part.improving(followed.parts->store));
  EXPECT_TRUE(same_bits(followed.part.pose(followed.parts->optimum), pose));
  EXPECT_EQ(followed.parts->optimum.value, value);
}

TEST(StreamOptimum, TakesInAPointThatDoesNotFit) {
  Followed followed;
  followed.settle();
  const double value = followed.parts->optimum.value;
  const std::uint32_t index = followed.free_point();
  const Foot foot = followed.measured(index).foot;
  const Mat3 back = followed.part.pose(followed.parts->optimum).rotation.transpose();
  followed.parts->store[index].position += back * ((2.0 * value - foot.distance) * foot.normal);
  followed.look_at(index);
  EXPECT_TRUE(followed.part.holds(index));
  EXPECT_TRUE(followed.part.improving(followed.parts->store));
  followed.settle();
  EXPECT_GT(followed.parts->optimum.value, 1.01 * value);
  EXPECT_LT(followed.parts->optimum.value, 2.0 * value);
}

TEST(StreamOptimum, TakesInNoPointThatDoesNotCount) {
  Followed followed;
  followed.settle();
  const std::uint32_t index = followed.free_point();
  followed.parts->store[index].outside_window = true;
  Measurement m = followed.measured(index);
  m.foot.distance = 100.0;
  followed.part.look_at(followed.parts->store, index, m);
  EXPECT_FALSE(followed.part.holds(index));
  followed.parts->store[index].outside_window = false;
  followed.part.look_at(followed.parts->store, index, m);
  EXPECT_TRUE(followed.part.holds(index));
}

TEST(StreamOptimum, HoldsNothingOnceItIsStopped) {
  Followed followed;
  followed.settle();
  std::uint32_t held = 0;
  for (std::uint32_t i = 0; i < followed.parts->store.size(); ++i) held += followed.part.holds(i);
  EXPECT_EQ(held, BoundTracker::kPlaces);
  followed.part.stop();
  EXPECT_FALSE(followed.part.leads());
  EXPECT_TRUE(followed.part.improving(followed.parts->store));
  for (std::uint32_t i = 0; i < followed.parts->store.size(); ++i) EXPECT_FALSE(followed.part.holds(i));
  followed.look_at(0);
  EXPECT_FALSE(followed.part.holds(0));
}

TEST(StreamOptimum, TellsOfTheSmallestTolerancesWhereThoseWantedCannotBeMet) {
  Followed wide(FitMode::constrained, 0.5);
  wide.follow();
  EXPECT_FALSE(wide.parts->optimum.infeasible);
  EXPECT_EQ(wide.parts->optimum.value, 0.0);
  Followed tight(FitMode::constrained, 0.004);
  for (int k = 0; k < 10; ++k) tight.follow_and_look();
  for (int k = 0; k < 10; ++k) tight.follow();  // it is known once the program rests
  EXPECT_TRUE(tight.parts->optimum.infeasible);
  EXPECT_GT(tight.parts->optimum.value, 0.004);
  EXPECT_EQ(tight.parts->optimum.smallest_tolerance, tight.parts->optimum.value);
  EXPECT_GT(tight.parts->optimum.certificate.count, 0U);
}

}  // namespace
}  // namespace bladefit::testing
