// Points tracked with wide vector registers, in lanes or one at a time, beside the same without them: the same bits.

#include <gtest/gtest.h>

#include <limits>

#include "core/fit/quadratic_model.hpp"
#include "core/geometry/nearest/global_projection.hpp"
#include "core/geometry/nearest/lane_projection.hpp"
#include "core/geometry/nearest/newton_walk.hpp"
#include "core/geometry/surface/span_newton.hpp"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {
namespace {

constexpr std::uint32_t kPoints = 400;
const double kRadius = 0.7;  ///< of the probe [mm]

/// A point near the design and the place that its foot is sought from.
struct Task {
  Vec3 r;
  SurfacePlace start;
};

class Lanes : public ::testing::TestWithParam<std::string> {
 protected:
  Lanes() : surface_(reference_design(GetParam()).surface()), frame_{surface_.middle(), surface_.half_diagonal()} {}

  /// Where there are no lanes every point is left to be sought by itself.
  void expect_none_found(bool available) const {
    const std::vector<Task> all = tasks(1e-5);
    LaneProjections feet(available);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) feet.enter(surface_, all[lane].r, all[lane].start);
    feet.find(surface_);
    EXPECT_EQ(feet.count(), static_cast<std::uint32_t>(kLanes));
    EXPECT_EQ(feet.walk(), nullptr);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) EXPECT_FALSE(feet.found(lane));
  }

  /// From near feet, as sweeps track them, to far ones, from which Newton's method may lead out of the span.
  [[nodiscard]] std::vector<Task> tasks(double apart) const {
    std::mt19937_64 random(11);
    std::vector<Task> out;
    while (out.size() < kPoints) {
      const SurfacePlace place = random_place(surface_, random);
      const SurfacePoint at = surface_.evaluate(place);
      const Vec3 off = uniform(random, -0.01, 0.01) * frame_.length * surface_.normal(place, at);
      const Vec3 moved(uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0));
      out.push_back({at.s + off + apart * frame_.length * moved, place});
    }
    return out;
  }

  [[nodiscard]] LaneProjections found(std::span<const Task> tasks, LaneRows& rows) const {
    LaneProjections feet;
    for (const Task& task : tasks) feet.enter(surface_, task.r, task.start);
    feet.find(surface_);
    LaneFrame frame{{frame_.pivot[0], frame_.pivot[1], frame_.pivot[2]},
                    frame_.length,
                    {x_[0], x_[1], x_[2], x_[3], x_[4], x_[5]},
                    kRadius,
                    {}};
    std::fill_n(frame.outward, kLanes, static_cast<double>(surface_.image().header().outward));
    take_rows(*feet.walk(), frame, rows);
    return feet;
  }

  /// What project_local(), foot_of() and distance_row() make of the task: the same bits.
  void expect_same(const Task& task, const LaneProjections& feet, const LaneRows& rows, std::uint32_t lane) const {
    const Projection alone = project_local(surface_, task.r, task.start), one = feet.projection(lane);
    ASSERT_TRUE(alone.converged);
    EXPECT_EQ(one.place.span, alone.place.span);
    EXPECT_EQ(one.place.u, alone.place.u);
    EXPECT_EQ(one.place.v, alone.place.v);
    EXPECT_EQ(one.at.s, alone.at.s);
    EXPECT_EQ(one.at.s_u, alone.at.s_u);
    EXPECT_EQ(one.at.s_v, alone.at.s_v);
    EXPECT_EQ(one.at.s_uu, alone.at.s_uu);
    EXPECT_EQ(one.at.s_uv, alone.at.s_uv);
    EXPECT_EQ(one.at.s_vv, alone.at.s_vv);
    EXPECT_EQ(one.offset, alone.offset);
    const Foot foot = foot_of(surface_, alone, kRadius);
    EXPECT_EQ(foot.kind, FootKind::interior);
    EXPECT_EQ(lane_of(rows.normal, lane), foot.normal);
    EXPECT_EQ(rows.distance[lane], foot.distance);
    const DistanceRow row = distance_row(alone, foot, task.r, x_, frame_);
    for (int k = 0; k < 6; ++k) EXPECT_EQ(rows.gradient[k][lane], row.gradient[k]);
    int entry = 0;
    for (int j = 0; j < 6; ++j) {
      for (int i = 0; i <= j; ++i, ++entry) EXPECT_EQ(rows.bend[entry][lane], row.bend(i, j));
    }
  }

  /// How many of the tasks lanes can do; each of these is compared.
  [[nodiscard]] std::uint32_t compared(double apart) const {
    const std::vector<Task> all = tasks(apart);
    std::uint32_t count = 0;
    for (std::size_t first = 0; first < all.size(); first += kLanes) {
      LaneRows rows;
      const LaneProjections feet = found({&all[first], kLanes}, rows);
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        if (!feet.found(lane) || !rows.regular[lane]) continue;
        expect_same(all[first + lane], feet, rows, lane);
        ++count;
      }
    }
    return count;
  }

  const Surface& surface_;
  MotionFrame frame_;
  Vec6 x_ = (Vec6() << 0.3, -0.2, 0.1, 0.5, 0.2, -0.4).finished();
};

TEST_P(Lanes, NotAtHandFindNothing) { expect_none_found(false); }

TEST_P(Lanes, AreOnePointsBits) {
  if (!lanes_available()) return expect_none_found(lanes_available());
  EXPECT_GT(compared(1e-5), kPoints * 9 / 10);
}

TEST_P(Lanes, GiveUpRatherThanLeaveTheSpan) {
  if (!lanes_available()) return expect_none_found(lanes_available());
  const std::uint32_t count = compared(0.02);
  EXPECT_GT(count, kPoints / 10);
  EXPECT_LT(count, kPoints * 9 / 10);
}

/// One point at a time with wide registers, beside the same without: wherever it ends.
TEST_P(Lanes, OfOnePointAreItsBits) {
  if (!lanes_available()) return expect_none_found(lanes_available());
  std::array<int, 3> ends{};
  for (const double apart : {1e-5, 0.02}) {
    for (const Task& one : tasks(apart)) {
      SpanTask task;
      task.taylor = surface_.taylor(one.start.span, nullptr);
      task.degree_u = task.degree_v = 3;
      for (int k = 0; k < 3; ++k) task.r[k] = one.r[k];
      task.last_step = kLastStep * frame_.length;
      task.slack = kDistanceRounding * frame_.length;
      SpanFoot plain{}, wide{};
      plain.distance_squared = wide.distance_squared = std::numeric_limits<double>::infinity();
      const SpanEnd end = newton_in_span(task, plain);
      ASSERT_EQ(end, newton_in_bicubic(task, wide));
      ++ends[static_cast<std::size_t>(end)];
      EXPECT_EQ(plain.moved, wide.moved);
      EXPECT_EQ(plain.distance_squared, wide.distance_squared);
      for (const auto number : {&SpanFoot::x, &SpanFoot::y, &SpanFoot::next_x, &SpanFoot::next_y})
        EXPECT_EQ(plain.*number, wide.*number);
      for (const auto numbers :
           {&SpanFoot::s, &SpanFoot::s_u, &SpanFoot::s_v, &SpanFoot::s_uu, &SpanFoot::s_uv, &SpanFoot::s_vv}) {
        for (int k = 0; k < 3; ++k) EXPECT_EQ((plain.*numbers)[k], (wide.*numbers)[k]);
      }
    }
  }
  EXPECT_GT(ends[static_cast<std::size_t>(SpanEnd::converged)], 50);
  EXPECT_GT(ends[static_cast<std::size_t>(SpanEnd::left)], 50);
}

/// What stands in the other lanes does not matter: nothing, or numbers that are none.
TEST_P(Lanes, DoNotSeeEachOther) {
  if (!lanes_available()) return expect_none_found(lanes_available());
  const std::vector<Task> all = tasks(1e-5);
  std::uint32_t compared = 0;
  for (std::size_t k = 0; k + 1 < 100; ++k) {
    std::array<Task, kLanes> among{all[k + 1], all[k], all[k + 1], all[k + 1]};
    among[3].r.setConstant(std::numeric_limits<double>::quiet_NaN());
    LaneRows rows, rows_among;
    const LaneProjections alone = found({&all[k], 1}, rows), feet = found(among, rows_among);
    EXPECT_FALSE(feet.found(3));
    ASSERT_EQ(alone.found(0), feet.found(1));
    if (!alone.found(0)) continue;
    ++compared;
    EXPECT_EQ(alone.projection(0).at.s, feet.projection(1).at.s);
    for (int entry = 0; entry < 21; ++entry) EXPECT_EQ(rows.bend[entry][0], rows_among.bend[entry][1]);
  }
  EXPECT_GT(compared, 90U);
}

INSTANTIATE_TEST_SUITE_P(Designs, Lanes, ::testing::Values("arl_fan", "dtmb4119", "pnsy_sub", "pnsy_3patch"));

}  // namespace
}  // namespace bladefit::testing
