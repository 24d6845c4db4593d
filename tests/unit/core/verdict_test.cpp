// Verdicts, their revisions, and calls that must change nothing.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "tests/support/localizer_session.hpp"

namespace bladefit::testing {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What a caller knows who reads every verdict and every revision.
class Caller {
 public:
  void hear(const Verdict& verdict) { told_[verdict.sequence] = verdict; }
  int drain(Localizer& localizer) {
    int count = 0;
    for (Verdict verdict; localizer.next_revision(verdict); ++count) {
      const Verdict& before = told_.at(verdict.sequence);
      EXPECT_TRUE(before.state != verdict.state || before.action != verdict.action) << "a revision of nothing";
      hear(verdict);
    }
    return count;
  }
  void expect_up_to_date(const Localizer& localizer) const {
    for (const auto& [sequence, told] : told_) {
      Verdict now;
      ASSERT_EQ(localizer.verdict_of(sequence, now), Status::ok);
      EXPECT_EQ(now.state, told.state) << sequence;
      EXPECT_EQ(now.action, told.action) << sequence;
    }
  }

 private:
  std::map<std::uint32_t, Verdict> told_;
};

/// State, action and tolerance follow from distance and region alone.
void expect_consistent(const Verdict& v, const LocalizerConfig& config) {
  EXPECT_EQ(v.region, region_at(config.tolerance, v.foot.patch, v.foot.u, v.foot.v));
  EXPECT_EQ(v.tolerance_mm, tolerance_at(config.tolerance, v.foot.patch, v.foot.u, v.foot.v));
  const bool beyond = std::abs(v.foot.distance) > v.tolerance_mm;
  if (v.state == PointState::in) {
    EXPECT_FALSE(beyond);
  }
  if (v.state == PointState::out) {
    EXPECT_TRUE(beyond);
    const Action by_sign = v.foot.distance > 0.0 ? Action::cut : Action::weld;
    EXPECT_EQ(v.action, v.foot.border == FootBorder::outer ? Action::none : by_sign);
  } else {
    EXPECT_EQ(v.action, Action::none);
  }
  const bool at_outer_edge = v.foot.border != FootBorder::none && v.foot.beyond <= v.tolerance_mm;
  EXPECT_EQ(v.state == PointState::rejected, at_outer_edge);
  EXPECT_EQ(v.left_out, at_outer_edge ? LeftOut::edge : LeftOut::none);
  EXPECT_EQ(v.fitted, v.foot.kind == FootKind::interior);
  EXPECT_GT(v.uncertainty_mm, 0.0);
}

TEST(Verdicts, RevisionsTellEveryChange) {
  const BladeSession s;
  OwnedLocalizer stream(s.design.image(), s.config);
  Caller caller;
  int revisions = 0;
  for (const ProbePoint& point : s.points) {
    Verdict verdict;
    ASSERT_TRUE(succeeded(stream->push(point, verdict)));
    expect_consistent(verdict, s.config);
    caller.hear(verdict);
    revisions += caller.drain(*stream);
    if (point.sequence % 100 == 0) caller.expect_up_to_date(*stream);
  }
  stream->conclude();
  ASSERT_EQ(refine_fully(*stream), Status::ok);
  revisions += caller.drain(*stream);
  caller.expect_up_to_date(*stream);
  EXPECT_GT(revisions, 0);
  for (const ProbePoint& point : s.points) {
    Verdict verdict;
    ASSERT_EQ(stream->verdict_of(point.sequence, verdict), Status::ok);
    expect_consistent(verdict, s.config);
    EXPECT_NE(verdict.state, PointState::pending);
  }
}

/// The counts of a report are those of the verdicts.
TEST(Verdicts, ReportCountsThem) {
  const BladeSession s;
  OwnedLocalizer stream(s.design.image(), s.config);
  push_all(*stream, s.points);
  ASSERT_EQ(refine_fully(*stream), Status::ok);
  std::uint32_t out[2] = {0, 0}, rejected = 0, fitted = 0;
  for (const ProbePoint& point : s.points) {
    Verdict verdict;
    ASSERT_EQ(stream->verdict_of(point.sequence, verdict), Status::ok);
    if (verdict.state == PointState::out) ++out[static_cast<std::size_t>(verdict.region)];
    if (verdict.state == PointState::rejected) ++rejected;
    if (verdict.fitted) ++fitted;
  }
  const FitReport report = stream->fit();
  EXPECT_EQ(report.rest.judged_out, out[0]);
  EXPECT_EQ(report.leading_edge.judged_out, out[1]);
  EXPECT_EQ(report.rejected, rejected);
  EXPECT_GT(out[0] + out[1], 0U);
  EXPECT_EQ(report.rest.count + report.leading_edge.count, report.fitted);
  EXPECT_EQ(report.fitted, fitted);
}

TEST(Verdicts, ArePendingUntilThePoseIsDetermined) {
  const BladeSession s;
  OwnedLocalizer stream(s.design.image(), s.config);
  Verdict verdict;
  for (std::size_t k = 0; k < 11; ++k) {
    const Status status = stream->push(s.points[k], verdict);
    const FitReport report = stream->fit();
    EXPECT_EQ(verdict.state, PointState::pending) << k;
    EXPECT_EQ(status == Status::underdetermined, report.determined < 6) << k;
    EXPECT_LE(report.determined, k + 1);
    if (report.determined == 6) continue;
    EXPECT_EQ(report.status, FitStatus::underdetermined);
    EXPECT_TRUE(report.covariance.isZero());
  }
}

/// However many points, a flat patch never determines its own plane's motions: nothing that depends on them is judged.
TEST(Verdicts, OneSpotOfTheBladeDeterminesLittle) {
  const BladeSession s;
  OwnedLocalizer stream(s.design.image(), s.config);
  std::mt19937_64 random(8);
  const SurfacePlace place = s.design.surface().place_at(0, 0.25, 0.5);
  const SurfacePoint p = s.design.surface().evaluate(place);
  Verdict verdict;
  for (std::uint32_t k = 1; k <= 200; ++k) {
    const Vec3 r = p.s + 0.2 * random_vector(random);
    ASSERT_EQ(stream->push({k, 0, {r[0], r[1], r[2]}, {}, 0}, verdict), Status::underdetermined);
  }
  EXPECT_LE(stream->fit().determined, 3U);
  stream->conclude();
  (void)refine_fully(*stream);
  EXPECT_TRUE(stream->fit().pose.translation.allFinite());
}

class Refusals : public ::testing::Test {
 protected:
  Refusals() : disturbed_(s_.design.image(), s_.config), quiet_(s_.design.image(), s_.config) {}

  /// Pushes some points into both localizers.
  void advance(std::size_t from, std::size_t to) {
    Verdict a, b;
    for (std::size_t k = from; k < to; ++k) {
      ASSERT_EQ(disturbed_->push(s_.points[k], a), quiet_->push(s_.points[k], b));
      ASSERT_TRUE(identical(a, b));
    }
  }

  /// The point is refused and nothing changes, neither now nor later.
  void expect_refused(const ProbePoint& point, Status expected) {
    Verdict verdict;
    verdict.sequence = 4711;
    EXPECT_EQ(disturbed_->push(point, verdict), expected);
    EXPECT_EQ(verdict.sequence, 4711U) << "a verdict was written";
    EXPECT_EQ(disturbed_->stage(point), expected);
    EXPECT_TRUE(identical(disturbed_->fit(), quiet_->fit()));
  }

  BladeSession s_;
  OwnedLocalizer disturbed_, quiet_;
};

TEST_F(Refusals, LeaveTheStateAsBefore) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{50}, std::size_t{400}}) {
    advance(count == 0 ? 0 : count == 50 ? 0 : 50, count);
    const ProbePoint good = s_.points[count];
    for (std::size_t k = 0; k < 3; ++k) {
      for (const double bad : {kNan, kInfinity, -kInfinity}) {
        ProbePoint point = good;
        point.position[k] = bad;
        expect_refused(point, Status::not_finite);
        point = good;
        point.approach[k] = bad;
        expect_refused(point, Status::not_finite);
      }
    }
    ProbePoint point = good;
    point.sequence = 0;
    expect_refused(point, Status::out_of_range);
    point = good;
    point.position[1] = 1e9;
    expect_refused(point, Status::out_of_range);
    point = good;
    point.approach = {0.5, 0.5, 0.5};
    expect_refused(point, Status::out_of_range);
    if (count == 0) continue;
    expect_refused(s_.points[count - 1], Status::duplicate);
    expect_refused(s_.points[0], Status::duplicate);
  }
  advance(400, 600);
}

/// Coordinates that are numbers but nonsense are taken, and judged as what they are: far away.
TEST(Verdicts, SurviveAbsurdCoordinates) {
  const BladeSession s;
  OwnedLocalizer stream(s.design.image(), s.config);
  Verdict verdict;
  std::uint32_t sequence = 0;
  for (const double x : {1e6, -1e9, 1e30, 1e150, -1e300, 1e-300}) {
    (void)stream->push({++sequence, 0, {x, x, x}, {}, 0}, verdict);
    (void)stream->push({++sequence, 0, {0, -x, x}, {1, 0, 0}, 0}, verdict);
  }
  (void)stream->refine(24);
  (void)stream->fit();
  stream->reset();
  push_all(*stream, s.points);
  EXPECT_EQ(refine_fully(*stream), Status::ok);
}

TEST(Memory, IsCheckedBeforeItIsUsed) {
  const BladeSession s;
  const std::size_t size = Localizer::memory_required(s.config);
  AlignedBlock block(size + 64);
  Localizer* localizer = nullptr;
  const auto create = [&](std::span<std::byte> memory) {
    return Localizer::create(memory, s.design.image(), s.config, localizer);
  };
  EXPECT_EQ(create({}), Status::null_argument);
  for (const std::size_t offset : {1U, 8U, 32U, 63U}) {
    EXPECT_EQ(create(block.bytes().subspan(offset)), Status::misaligned);
  }
  EXPECT_EQ(create(block.bytes().first(size - 1)), Status::not_enough_memory);
  EXPECT_EQ(create(block.bytes().first(0)), Status::not_enough_memory);
  EXPECT_EQ(localizer, nullptr);
  EXPECT_EQ(create(block.bytes().first(size)), Status::ok);
  EXPECT_NE(localizer, nullptr);
  localizer = nullptr;
  EXPECT_EQ(Localizer::create(block.bytes(), DesignImage(), s.config, localizer), Status::null_argument);
}

/// Nothing is written outside of the block.
TEST(Memory, StaysInsideItsBlock) {
  BladeSession s;
  s.config.capacity = 100;
  const std::size_t size = Localizer::memory_required(s.config);
  AlignedBlock block(size + 256);
  std::fill(block.bytes().begin(), block.bytes().end(), std::byte{0xA5});
  Localizer* localizer = nullptr;
  ASSERT_EQ(Localizer::create(block.bytes().first(size), s.design.image(), s.config, localizer), Status::ok);
  push_all(*localizer, s.points);
  for (const std::byte b : block.bytes().subspan(size)) EXPECT_EQ(b, std::byte{0xA5});
}

TEST(Configuration, OutOfRangeIsRefused) {
  const BladeSession s;
  AlignedBlock block(Localizer::memory_required(s.config));
  const auto status = [&](auto change) {
    LocalizerConfig config = s.config;
    change(config);
    Localizer* localizer = nullptr;
    return Localizer::create(block.bytes(), s.design.image(), config, localizer);
  };
  using C = LocalizerConfig;
  EXPECT_EQ(status([](C&) {}), Status::ok);
  EXPECT_EQ(status([](C& c) { c.capacity = 5; }), Status::out_of_range);
  EXPECT_EQ(status([](C& c) { c.refresh_per_push = 1; }), Status::out_of_range);
  EXPECT_EQ(status([](C& c) { c.refresh_per_push = 65; }), Status::out_of_range);
  for (const double bad : {-1.0, kNan, kInfinity}) {
    EXPECT_EQ(status([&](C& c) { c.probe_radius_mm = bad; }), Status::out_of_range);
    EXPECT_EQ(status([&](C& c) { c.noise_floor_mm = bad; }), Status::out_of_range);
    EXPECT_EQ(status([&](C& c) { c.tolerance.transition = bad; }), Status::out_of_range);
    EXPECT_EQ(status([&](C& c) { c.window_low = bad; }), Status::out_of_range);
    EXPECT_EQ(status([&](C& c) { c.window_high = bad; }), Status::out_of_range);
  }
  EXPECT_EQ(status([](C& c) { c.noise_floor_mm = 0; }), Status::out_of_range);
  EXPECT_EQ(status([](C& c) { c.determined_mm = kNan; }), Status::out_of_range);
  EXPECT_EQ(status([](C& c) { c.tolerance.rest_mm = 0; }), Status::out_of_range);
  EXPECT_EQ(status([](C& c) { c.tolerance.leading_edge_mm = kNan; }), Status::out_of_range);
  EXPECT_EQ(status([](C& c) { c.tolerance.box_count = 129; }), Status::out_of_range);
  EXPECT_EQ(status([](C& c) { c.tolerance.boxes[0].patch = 1; }), Status::out_of_range);
  EXPECT_EQ(status([](C& c) { c.tolerance.boxes[0].u_min = 0.7; }), Status::out_of_range);
  EXPECT_EQ(status([](C& c) { c.start.rotation *= 1.1; }), Status::out_of_range);
  EXPECT_EQ(status([](C& c) { c.start.rotation.col(0) *= -1; }), Status::out_of_range);
  EXPECT_EQ(status([](C& c) { c.start.rotation(1, 1) = kNan; }), Status::out_of_range);
  EXPECT_EQ(status([](C& c) { c.start.translation[2] = kNan; }), Status::out_of_range);
}

}  // namespace
}  // namespace bladefit::testing
