// Points tracked in the lanes of vector registers, beside the same points one at a time: the same bits.

#include <gtest/gtest.h>

#include "core/fit/measurement.hpp"
#include "core/fit/quadratic_model.hpp"
#include "core/geometry/newton_walk.hpp"
#include "tests/unit/core_fixtures.hpp"

namespace bladefit::testing {
namespace {

constexpr std::uint32_t kPoints = 400;
const double kRadius = 0.7;  ///< of the probe [mm]

/// A point near the design and the place that its foot is sought from.
struct Task {
  Vec3 r;
  SurfacePlace start;
};

Vec3 lane_of(const LaneNumbers (&numbers)[3], int lane) {
  return {numbers[0][lane], numbers[1][lane], numbers[2][lane]};
}

class Lanes : public ::testing::TestWithParam<std::string> {
 protected:
  Lanes() : surface_(reference_design(GetParam()).surface()), frame_{surface_.middle(), surface_.half_diagonal()} {}

  void SetUp() override {
    if (!lanes_at_hand()) GTEST_SKIP() << "this processor has no such lanes: points are tracked one at a time";
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

  void walk(const Task* tasks, LaneWalk& walk, LaneRows& rows) const {
    for (int lane = 0; lane < kLanes; ++lane) {
      const Task& task = tasks[lane];
      const SpanDomain d = surface_.domain(task.start.span);
      walk.taylor[lane] = surface_.taylor(task.start.span);
      walk.per_u[lane] = 1.0 / (d.u_max - d.u_min);
      walk.per_v[lane] = 1.0 / (d.v_max - d.v_min);
      walk.x[lane] = (task.start.u - d.u_min) * walk.per_u[lane] - 0.5;
      walk.y[lane] = (task.start.v - d.v_min) * walk.per_v[lane] - 0.5;
      for (int k = 0; k < 3; ++k) walk.r[k][lane] = task.r[k];
    }
    walk.last_step = kLastStep * frame_.length;
    walk.slack = kDistanceRounding * frame_.length;
    walk_lanes(walk);
    const LaneFrame frame{{frame_.pivot[0], frame_.pivot[1], frame_.pivot[2]},
                          frame_.length,
                          {x_[0], x_[1], x_[2], x_[3], x_[4], x_[5]},
                          static_cast<double>(surface_.image().header().outward),
                          kRadius};
    take_rows(walk, frame, rows);
  }

  /// What newton_walk(), foot_of() and distance_row() make of the task: the same bits.
  void expect_same(const Task& task, const LaneWalk& walk, const LaneRows& rows, int lane) const {
    const Projection alone = project_local(surface_, task.r, task.start);
    ASSERT_TRUE(alone.converged);
    EXPECT_EQ(lane_of(walk.s, lane), alone.at.s);
    EXPECT_EQ(lane_of(walk.s_u, lane), alone.at.s_u);
    EXPECT_EQ(lane_of(walk.s_v, lane), alone.at.s_v);
    EXPECT_EQ(lane_of(walk.s_uu, lane), alone.at.s_uu);
    EXPECT_EQ(lane_of(walk.s_uv, lane), alone.at.s_uv);
    EXPECT_EQ(lane_of(walk.s_vv, lane), alone.at.s_vv);
    EXPECT_EQ(lane_of(walk.offset, lane), alone.offset);
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
      LaneWalk walked;
      LaneRows rows;
      walk(&all[first], walked, rows);
      for (int lane = 0; lane < kLanes; ++lane) {
        if (!walked.converged[lane] || !rows.regular[lane]) continue;
        expect_same(all[first + static_cast<std::size_t>(lane)], walked, rows, lane);
        ++count;
      }
    }
    return count;
  }

  const Surface& surface_;
  MotionFrame frame_;
  Vec6 x_ = (Vec6() << 0.3, -0.2, 0.1, 0.5, 0.2, -0.4).finished();
};

TEST_P(Lanes, AreOnePointsBits) { EXPECT_GT(compared(1e-5), kPoints * 9 / 10); }

TEST_P(Lanes, GiveUpRatherThanLeaveTheSpan) {
  const std::uint32_t count = compared(0.02);
  EXPECT_GT(count, kPoints / 10);
  EXPECT_LT(count, kPoints * 9 / 10);
}

/// What stands in the other lanes does not matter, not even numbers that are none.
TEST_P(Lanes, DoNotSeeEachOther) {
  const std::vector<Task> all = tasks(1e-5);
  for (std::size_t k = 0; k + 1 < 100; ++k) {
    const Task alone[kLanes] = {all[k], all[k], all[k], all[k]};
    Task among[kLanes] = {all[k + 1], all[k], all[k + 1], all[k + 1]};
    among[3].r.setConstant(std::numeric_limits<double>::quiet_NaN());
    LaneWalk first, second;
    LaneRows first_rows, second_rows;
    walk(alone, first, first_rows);
    walk(among, second, second_rows);
    EXPECT_FALSE(second.converged[3]);
    ASSERT_EQ(first.converged[1], second.converged[1]);
    if (!first.converged[1]) continue;
    EXPECT_EQ(lane_of(first.s, 1), lane_of(second.s, 1));
    for (int entry = 0; entry < 21; ++entry) EXPECT_EQ(first_rows.bend[entry][1], second_rows.bend[entry][1]);
  }
}

INSTANTIATE_TEST_SUITE_P(Designs, Lanes, ::testing::Values("arl_fan", "dtmb4119", "pnsy_sub", "pnsy_3patch"));

}  // namespace
}  // namespace bladefit::testing
