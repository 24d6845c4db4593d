// What is known of the sweeps of a refinement.

#include <gtest/gtest.h>

#include <limits>

#include "core/localizer/sweep.hpp"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::testing {
namespace {

/// Sweeps of a pose that is shifted along x.
struct Sweeping {
  Sweeping() : problem(reference_design("dtmb4119").image(), LocalizerConfig()), sweep(problem) {
    sweep.restart(Pose());
    tracked.runner_up.margin = 1.0;
    staged.runner_up.margin = std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] Vec6 step(double lengths) const { return lengths * problem.frame.length * Vec6::Unit(3); }
  /// Begins the next sweep so many half diagonals farther.
  void begin(double lengths) {
    pose = moved(pose, step(lengths), problem.frame);
    sweep.begin(pose);
  }
  /// Ends a sweep with a step of this length [half diagonals].
  void end(double lengths) {
    sweep.set_last_step(step(lengths));
    if (!sweep.last_step_counts()) sweep.prove_next();
    sweep.end();
  }
  /// The sweep that begins next, or is under way, is to prove every foot.
  void prove() {
    sweep.prove_next();
    sweep.end();
  }
  void count(bool changed, bool proven) {
    Measurement m;
    m.changed = changed;
    m.proven = proven;
    sweep.count(m);
  }
  [[nodiscard]] Search search() const { return sweep.search_of(tracked); }

  FitProblem problem;
  Sweep sweep;
  Pose pose;
  StoredPoint tracked, staged;
};

constexpr double kShort = 0.5 * tuning::kCheckedAbove, kLong = 2.0 * tuning::kCheckedAbove;

TEST(Sweep, TracksFeetAtFirst) {
  Sweeping s;
  s.begin(0.0);
  EXPECT_EQ(s.search(), Search::if_doubtful);
  EXPECT_EQ(s.sweep.search_of(s.staged), Search::if_doubtful);
  EXPECT_FALSE(s.sweep.proves());
}

TEST(Sweep, SearchesFeetAgainWhileThePoseTravels) {
  Sweeping s;
  s.begin(1.01 * tuning::kTravelsBeyond);
  EXPECT_EQ(s.search(), Search::always);
  EXPECT_EQ(s.sweep.search_of(s.staged), Search::if_doubtful) << "a point that was staged from a place";
  s.end(kLong);
  s.begin(0.99 * tuning::kTravelsBeyond);
  EXPECT_EQ(s.search(), Search::if_doubtful) << "since the sweep before, not since the first";
}

TEST(Sweep, SearchesEveryFootOnceTheLastStepWasShort) {
  Sweeping s;
  s.begin(0.0);
  s.end(kLong);
  s.begin(0.0);
  EXPECT_EQ(s.search(), Search::if_doubtful);
  s.end(kShort);
  s.begin(kShort);
  EXPECT_EQ(s.search(), Search::always);
  EXPECT_EQ(s.sweep.search_of(s.staged), Search::always) << "staged ones too";
}

TEST(Sweep, SearchesEveryFootWhenItIsToProve) {
  Sweeping s;
  s.begin(0.0);
  s.prove();
  EXPECT_EQ(s.search(), Search::always);
}

TEST(Sweep, SearchesNoFootTwiceWhileThePoseRests) {
  Sweeping s;
  s.prove();
  s.begin(0.0);
  s.end(0.0);
  for (int k = 0; k < 2; ++k) {
    s.begin(0.4 * tuning::kSearchHolds);
    EXPECT_EQ(s.search(), Search::if_doubtful) << k;
    s.end(0.0);
  }
  s.begin(0.4 * tuning::kSearchHolds);
  EXPECT_EQ(s.search(), Search::always) << "small steps add up";
  s.end(0.0);
  s.begin(0.4 * tuning::kSearchHolds);
  EXPECT_EQ(s.search(), Search::if_doubtful) << "counted from the new search";
}

TEST(Sweep, SearchesAgainAfterASearchThatMetItsCap) {
  Sweeping s;
  s.prove();
  s.begin(0.0);
  s.count(false, false);
  EXPECT_EQ(s.sweep.unproven(), 1U);
  s.end(0.0);
  EXPECT_EQ(s.sweep.unproven(), 0U);
  s.begin(0.0);
  EXPECT_EQ(s.search(), Search::always);
}

TEST(Sweep, ProvesWhereEveryFootWasSoughtAndNoneIsAnother) {
  Sweeping s;
  s.begin(0.0);
  s.count(false, true);
  EXPECT_FALSE(s.sweep.proves()) << "feet were tracked";
  s.end(0.0);
  s.begin(0.0);
  s.count(false, true);
  EXPECT_TRUE(s.sweep.proves());
  s.count(true, true);
  EXPECT_FALSE(s.sweep.proves());
  s.end(0.0);
  s.begin(0.0);
  EXPECT_TRUE(s.sweep.proves()) << "of this sweep alone";
}

TEST(Sweep, ComparesStepsAboveRoundingOnly) {
  Sweeping s;
  s.sweep.set_last_step(s.step(kShort));
  EXPECT_FALSE(s.sweep.last_step_counts());
  s.sweep.set_last_step(s.step(kLong));
  EXPECT_TRUE(s.sweep.last_step_counts());
}

TEST(Sweep, BeginsAgainWithASweepThatTakesRows) {
  Sweeping s;
  s.begin(0.0);
  s.end(0.0);
  s.begin(0.0);
  EXPECT_EQ(s.sweep.number(), 2U);
  EXPECT_EQ(s.search(), Search::always);
  s.sweep.begin_again();
  s.sweep.end();
  s.begin(0.0);
  EXPECT_EQ(s.sweep.number(), 1U) << "no step is compared with those before";
  EXPECT_EQ(s.search(), Search::if_doubtful);
  EXPECT_FALSE(s.sweep.proves());
}

TEST(Sweep, ForgetsEverythingWhenARefinementBegins) {
  Sweeping s;
  s.prove();
  s.begin(0.0);
  s.count(true, false);
  s.sweep.set_last_pose(moved(Pose(), s.step(1.0), s.problem.frame));
  s.end(0.0);
  s.begin(0.0);
  s.sweep.restart(s.pose);
  EXPECT_EQ(s.sweep.number(), 0U);
  EXPECT_EQ(s.sweep.unproven(), 0U);
  EXPECT_EQ(s.sweep.last_step(), Vec6(Vec6::Zero()));
  EXPECT_EQ(s.sweep.last_pose().translation, Vec3(Vec3::Zero()));
  EXPECT_EQ(s.search(), Search::if_doubtful);
  s.prove();
  s.begin(0.0);
  EXPECT_EQ(s.search(), Search::always) << "what was proven before is not";
}

}  // namespace
}  // namespace bladefit::testing
