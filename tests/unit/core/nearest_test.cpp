// The global nearest point against brute force, on every design of tests/data. Number of cases and seed by
// RC_PARAMS="max_success=1000 seed=...".

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/geometry/nearest/nearest_so_far.hpp"
#include "tests/unit/core/brute_force.hpp"

namespace bladefit::testing {
namespace {

constexpr double kSame = 1e-9;       ///< distances this near are equal [half diagonals]
constexpr double kFocal = 1e-3;      ///< at a centre of curvature all about is nearly equally near [half diagonals]
constexpr double kNotFacing = 1e-9;  ///< normals this near to the silhouette may count as either

class NearestPoint : public ::testing::TestWithParam<std::string> {
 protected:
  NearestPoint() : design_(reference_design(GetParam())), surface_(design_.surface()), size_(design_.size()) {}

  [[nodiscard]] const BruteForce& brute() const {
    if (!brute_) brute_ = std::make_unique<BruteForce>(surface_, 5);
    return *brute_;
  }

  /// Runs `body` with random numbers whose seed a failure prints.
  template <class F>
  void property(const std::string& what, F body) const {
    EXPECT_TRUE(rc::check(GetParam() + ": " + what, [&] {
      const auto seed = *rc::gen::noShrink(rc::gen::arbitrary<std::uint64_t>());
      std::mt19937_64 random(seed);
      body(random);
    }));
  }

  [[nodiscard]] GlobalProjection nearest(const Vec3& r, const Vec3& approach = Vec3::Zero(), double margin = 0.0,
                                         const Projection* hint = nullptr) const {
    return project_global(surface_, {r, approach, margin}, hint);
  }

  /// The localizer takes a tracked foot as it is.
  [[nodiscard]] bool trusted(const Projection& p, const Vec3& approach) const {
    return p.converged && !p.fixed_u && !p.fixed_v && faces_probe(surface_, p, approach);
  }

  /// The foot is on the surface, and is of the kind that it says.
  void assert_foot(const Vec3& r, const Projection& p) const {
    RC_ASSERT(p.converged);
    RC_ASSERT((surface_.evaluate(p.place).s - p.at.s).norm() <= kSame * size_);
    RC_ASSERT((r - p.at.s - p.offset).norm() <= kSame * size_);
    const SpanDomain d = surface_.domain(p.place.span);
    RC_ASSERT((p.place.u >= d.u_min && p.place.u <= d.u_max && p.place.v >= d.v_min && p.place.v <= d.v_max));
    // The last step is that short as a whole: where the parameter lines are nearly parallel, its parts along them are
    // longer, and one of them may be cut off at a side, which leaves the other without its counterpart.
    const double area = p.at.s_u.cross(p.at.s_v).norm(), lengths = p.at.s_u.norm() * p.at.s_v.norm();
    const bool at_side = p.place.u == 0.0 || p.place.u == 1.0 || p.place.v == 0.0 || p.place.v == 1.0;
    const double left = kSame * size_ * (at_side && area > 0.0 ? lengths / area : 1.0);
    const auto assert_direction = [&](double t, const Vec3& tangent, bool fixed) {
      const double along = tangent.norm() > 0.0 ? p.offset.dot(tangent) / tangent.norm() : 0.0;
      if (fixed) {
        RC_ASSERT((t == 0.0 || t == 1.0));
        // To within rounding: the last step moves the other parameter, and the offset with it.
        RC_ASSERT((t == 0.0 ? along < kSame * size_ : along > -kSame * size_));
      } else {
        RC_ASSERT(std::abs(along) <= left);
      }
    };
    assert_direction(p.place.u, p.at.s_u, p.fixed_u);
    assert_direction(p.place.v, p.at.s_v, p.fixed_v);
    const Foot foot = foot_of(surface_, p, 0.25);
    const int fixed = (p.fixed_u ? 1 : 0) + (p.fixed_v ? 1 : 0);
    const auto& joints = surface_.span(p.place.span).joints;
    const bool joined =
        std::any_of(std::begin(joints), std::end(joints), [](std::uint64_t parts) { return parts != 0; });
    RC_ASSERT((static_cast<int>(foot.kind) == fixed || (joined && static_cast<int>(foot.kind) < fixed)));
    const double length = p.offset.norm();
    // Across a smooth joint an offset may lean by a gap, or a little more than the bend.
    const bool leans = fixed > 0 && foot.kind == FootKind::interior;
    const double shorter = leans ? joint_gap(size_) + kMostBend * length : kSame * size_;
    RC_ASSERT(std::abs(foot.distance + 0.25) <= length + kSame * size_);
    RC_ASSERT(std::abs(foot.distance + 0.25) >= length - shorter);
    if (foot.border == FootBorder::outer || foot.border == FootBorder::joint_end) {
      RC_ASSERT(foot.distance + 0.25 > 0.0);
    }
  }

  const CompiledDesign& design_;
  const Surface& surface_;
  double size_;

 private:
  mutable std::unique_ptr<BruteForce> brute_;
};

TEST_P(NearestPoint, IsNeverFartherThanBruteForce) {
  property("never farther", [&](std::mt19937_64& random) {
    for (int k = 0; k < 5; ++k) {
      const auto [r, focal] = random_query_point(surface_, random);
      const GlobalProjection global = nearest(r);
      RC_ASSERT((global.proven || focal));
      RC_ASSERT(global.faces);
      assert_foot(r, global.nearest);
      const double least = brute().nearest_facing(brute().minima(r), Vec3::Zero(), 0.0);
      RC_ASSERT(global.nearest.offset.norm() <= least + (global.proven ? kSame : kFocal) * size_);
    }
  });
}

/// An approach vector as a machine would send it, or any other one.
Vec3 random_approach(const Surface& surface, const Vec3& r, std::mt19937_64& random) {
  if (random() % 3 == 0) return random_direction_in_space(random);
  const SurfacePlace place = project_global(surface, {r, Vec3::Zero(), 0.0}, nullptr).nearest.place;
  const Vec3 n = surface.normal(place, surface.evaluate(place));
  const double side = random() % 2 == 0 ? 1.0 : -1.0;
  return (side * n + uniform(random, 0, 1) * random_direction_in_space(random)).normalized();
}

TEST_P(NearestPoint, FacesTheProbeWhereAnythingDoes) {
  property("faces the probe", [&](std::mt19937_64& random) {
    for (int k = 0; k < 5; ++k) {
      const auto [r, focal] = random_query_point(surface_, random);
      const Vec3 approach = random_approach(surface_, r, random);
      const GlobalProjection global = nearest(r, approach);
      RC_ASSERT((global.proven || focal));
      assert_foot(r, global.nearest);
      const std::vector<Projection> minima = brute().minima(r);
      const double facing = brute().nearest_facing(minima, approach, kNotFacing);
      if (std::isfinite(facing)) {
        RC_ASSERT(global.faces);
        RC_ASSERT(global.nearest.offset.norm() <= facing + (global.proven ? kSame : kFocal) * size_);
      }
      RC_ASSERT(global.faces == faces_probe(surface_, global.nearest, approach));
      if (!global.faces) {
        const double least = brute().nearest_facing(minima, Vec3::Zero(), 0.0);
        RC_ASSERT(global.nearest.offset.norm() <= least + kSame * size_);
      }
    }
  });
}

TEST_P(NearestPoint, DoesNotDependOnTheHint) {
  property("hints change nothing", [&](std::mt19937_64& random) {
    for (int k = 0; k < 10; ++k) {
      const auto [r, focal] = random_query_point(surface_, random);
      const Vec3 approach = random() % 2 == 0 ? Vec3(Vec3::Zero()) : random_approach(surface_, r, random);
      const double margin = random() % 2 == 0 ? 0.0 : 2e-3 * size_;
      const Projection hint = project_local(surface_, r, random_place(surface_, random));
      const GlobalProjection plain = nearest(r, approach, margin), hinted = nearest(r, approach, margin, &hint);
      RC_ASSERT((hinted.proven || focal || margin > 0.0));
      if (!hinted.proven || !plain.proven) continue;
      RC_ASSERT(hinted.faces == plain.faces);
      RC_ASSERT(std::abs(hinted.nearest.offset.norm() - plain.nearest.offset.norm()) <= kSame * size_);
      // Two places may be equally near; then the margin to the runner-up is nothing.
      if ((hinted.nearest.at.s - plain.nearest.at.s).norm() > 1e-6 * size_) {
        RC_ASSERT(plain.runner_up.margin <= 2.0 * kSame * size_);
      }
    }
  });
}

/// The rule by which the localizer tracks feet: moved by less than half its margin, a foot that Newton still reaches
/// and that still faces the probe is the nearest one. Near a centre of curvature a new minimum may be born meanwhile,
/// which the margin cannot know of; the points are drawn to find such places, and still fewer than one move in a
/// thousand does.
TEST_P(NearestPoint, MarginKeepsTheTrackedFoot) {
  const double margin = 2e-3 * size_;
  int tracked = 0, wrong = 0, proven = 0, unproven = 0;
  property("margin", [&](std::mt19937_64& random) {
    for (int k = 0; k < 10; ++k) {
      const Vec3 r = random_query_point(surface_, random).r;
      const Vec3 approach = random() % 2 == 0 ? Vec3(Vec3::Zero()) : random_approach(surface_, r, random);
      const GlobalProjection before = nearest(r, approach, margin);
      if (!before.proven) {
        // A runner-up within the margin may be as hard to tell as a focal point; then nothing is tracked.
        RC_ASSERT(before.runner_up.margin == 0.0);
        ++unproven;
        continue;
      }
      ++proven;
      RC_ASSERT((before.runner_up.margin >= 0.0 && before.runner_up.margin <= margin * (1.0 + 1e-9)));
      for (int move = 0; move < 4; ++move) {
        const Vec3 there = r + uniform(random, 0, 0.4999) * before.runner_up.margin * random_direction_in_space(random);
        const Projection foot = project_local(surface_, there, before.nearest.place);
        if (!trusted(foot, approach)) continue;
        ++tracked;
        if (foot.offset.norm() > nearest(there, approach).nearest.offset.norm() + kSame * size_) ++wrong;
      }
    }
  });
  EXPECT_GT(tracked, 0);
  EXPECT_LE(1000 * wrong, tracked);
  EXPECT_LE(100 * unproven, proven + unproven) << "more than one in a hundred cannot be proven";
}

/// Moved by less than half the margin to the third, the nearer of the tracked foot and its tracked runner-up is the
/// nearest one. All these points have a runner-up, so a centre of curvature may be near, about which a third one may be
/// born.
TEST_P(NearestPoint, MarginToThirdKeepsOneOfTheTwo) {
  const double margin = 2e-3 * size_;
  int weighed = 0, swapped = 0, wrong = 0;
  property("margin to third", [&](std::mt19937_64& random) {
    const Vec3 r = equally_near_to_two(surface_, random) + 1e-5 * size_ * random_direction_in_space(random);
    const GlobalProjection before = nearest(r, Vec3::Zero(), margin);
    const RunnerUp& runner_up = before.runner_up;
    RC_ASSERT((runner_up.margin_to_third >= 0.0 && runner_up.margin_to_third <= 0.25 * margin * (1.0 + 1e-9)));
    if (runner_up.margin >= runner_up.margin_to_third) return;
    const Projection rival = project_local(surface_, r, runner_up.place);
    RC_ASSERT(std::abs(rival.offset.norm() - before.nearest.offset.norm() - runner_up.margin) <= kSame * size_);
    for (int move = 0; move < 4; ++move) {
      const Vec3 there = r + uniform(random, 0, 0.4999) * runner_up.margin_to_third * random_direction_in_space(random);
      const Projection foot = project_local(surface_, there, before.nearest.place);
      const Projection other = project_local(surface_, there, runner_up.place);
      if (!foot.converged || !other.converged) continue;
      ++weighed;
      if (other.offset.norm() < foot.offset.norm()) ++swapped;
      const double found = std::min(foot.offset.norm(), other.offset.norm());
      if (found > nearest(there).nearest.offset.norm() + kSame * size_) ++wrong;
    }
  });
  std::printf("[ figures  ] %d moves, after %d the runner-up was the nearer, after %d a third one\n", weighed, swapped,
              wrong);
  EXPECT_GT(swapped, 20);
  EXPECT_LE(100 * wrong, weighed);
}

INSTANTIATE_TEST_SUITE_P(AllCases, NearestPoint, ::testing::ValuesIn(reference_case_names()),
                         [](const auto& one) { return one.param; });

/// Where no local minimum faces the probe a descent from every leaf would find none: a few may try.
TEST(NearestSoFar, TakesAFewStartsUntilSomethingIsFound) {
  const CompiledDesign& design = reference_design("dtmb4119");
  const Vec3 r(10.0, 60.0, 20.0);
  const ProjectionQuery query{r, Vec3::UnitX()};
  NearestSoFar none(design.surface(), query), one(design.surface(), query);
  int taken = 0;
  for (int k = 0; k < 1000; ++k) taken += none.takes_start() ? 1 : 0;
  EXPECT_GE(taken, 4);
  EXPECT_LE(taken, 32);
  EXPECT_TRUE(one.takes_start());
  one.consider(project_global(design.surface(), query, nullptr).nearest);
  ASSERT_TRUE(one.found());
  EXPECT_FALSE(one.takes_start());
}

}  // namespace
}  // namespace bladefit::testing
