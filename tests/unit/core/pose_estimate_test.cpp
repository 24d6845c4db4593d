// The pose, and how well it is known.

#include <gtest/gtest.h>

#include "tests/support/localizer_fixtures.hpp"
#include "tests/unit/core/owned_parts.hpp"

namespace bladefit::testing {
namespace {

using Undetermined = PoseEstimate::Undetermined;

constexpr std::uint32_t kCount = 100;

Pose start_pose() { return {rotation_of({0.02, -0.03, 0.01}), {1.0, -2.0, 3.0}}; }

LocalizerConfig started_config(std::uint8_t locked) {
  LocalizerConfig config = config_of(read_case("dtmb4119"), 10);
  config.start = start_pose();
  config.locked = locked;
  return config;
}

/// An estimate at its start pose, and sums about that with a minimum where a test wants it.
struct Guess {
  explicit Guess(std::uint8_t locked = 0)
      : problem(reference_design("dtmb4119").image(), started_config(locked)), loss(problem), estimate(problem) {
    model.reference = start_pose();
    estimate.reset(model);
  }

  /// `strength`: eigenvalues of the information matrix; `square`: sum of 1/2 d^2 that is left at the minimum.
  void ask_for(const Vec6& minimum, const Vec6& strength, double square = 1e-6) {
    model.gauss = strength.asDiagonal();
    model.gradient = -(model.gauss * minimum);
    model.half_square = square + 0.5 * minimum.dot(model.gauss * minimum);
    model.count = kCount;
    model.weight = kCount;
  }
  [[nodiscard]] Minimum minimum(bool concluded = false, Undetermined undetermined = Undetermined::to_start) const {
    return estimate.minimum_of(model, loss, concluded, undetermined);
  }
  [[nodiscard]] Vec6 from_start(const Pose& pose) const { return motion_between(start_pose(), pose, problem.frame); }

  FitProblem problem;
  LossSchedule loss;
  PoseEstimate estimate;
  QuadraticModel model;
};

const Vec6 kStrong = Vec6::Constant(kCount);
const Vec6 kTarget = (Vec6() << 0.1, -0.2, 0.3, -0.1, 0.2, 0.4).finished();

Vec6 without_last() {
  Vec6 strength = kStrong;
  strength[5] = 0.0;
  return strength;
}

Vec6 unit(int k, double length) { return length * Vec6::Unit(k); }

TEST(PoseEstimate, IsMovedByOneCallAloneThatCountsTheRevision) {
  Guess guess;
  guess.ask_for(kTarget, kStrong);
  const Minimum minimum = guess.minimum();
  guess.estimate.know(minimum);
  guess.estimate.redetermine();
  guess.estimate.set_last_step(1.0);
  EXPECT_TRUE(same_bits(guess.estimate.pose(), start_pose()));
  EXPECT_EQ(guess.estimate.revision(), 0U);
  guess.estimate.move_to(minimum.pose);
  EXPECT_TRUE(same_bits(guess.estimate.pose(), minimum.pose));
  EXPECT_EQ(guess.estimate.revision(), 1U);
  guess.estimate.move_to(minimum.pose);
  EXPECT_EQ(guess.estimate.revision(), 2U);
  guess.estimate.reset(QuadraticModel());
  EXPECT_TRUE(same_bits(guess.estimate.pose(), start_pose()));
  EXPECT_EQ(guess.estimate.revision(), 0U);
}

TEST(PoseEstimate, FindsTheMinimumOfTheSums) {
  Guess guess;
  guess.ask_for(kTarget, kStrong);
  const Minimum minimum = guess.minimum();
  EXPECT_EQ(minimum.determination.rank, 6U);
  EXPECT_LT((guess.from_start(minimum.pose) - kTarget).norm(), 1e-12);
  EXPECT_NEAR(minimum.step, kTarget.norm(), 1e-12);
}

TEST(PoseEstimate, GivesTheSameMinimumTwiceAndChangesNothingByAsking) {
  Guess guess;
  guess.ask_for(kTarget, without_last());
  const Minimum first = guess.minimum(), second = guess.minimum();
  EXPECT_TRUE(same_bits(first.pose, second.pose));
  EXPECT_EQ(first.covariance, second.covariance);
  EXPECT_EQ(first.sigma, second.sigma);
  EXPECT_EQ(first.step, second.step);
  EXPECT_EQ(first.determination.rank, second.determination.rank);
  EXPECT_FALSE(guess.estimate.determined());
  EXPECT_TRUE(same_bits(guess.estimate.pose(), start_pose()));
}

TEST(PoseEstimate, LeadsDirectionsThatAreNotDeterminedBackToTheStartOrNowhere) {
  Guess guess;
  guess.ask_for(unit(3, 0.2), without_last());
  guess.estimate.move_to(moved(start_pose(), unit(5, 0.3), guess.problem.frame));
  const Minimum back = guess.minimum(false, Undetermined::to_start);
  const Minimum stays = guess.minimum(false, Undetermined::as_they_are);
  EXPECT_EQ(back.determination.rank, 5U);
  EXPECT_LT((guess.from_start(back.pose) - unit(3, 0.2)).norm(), 1e-12);
  EXPECT_LT((guess.from_start(stays.pose) - unit(3, 0.2) - unit(5, 0.3)).norm(), 1e-12);
}

TEST(PoseEstimate, UsesADirectionThatIsWeaklyDeterminedOnceTheStreamIsConcluded) {
  Guess guess;
  Vec6 strength = kStrong;
  strength[5] = 1e-6;
  guess.ask_for(kTarget, strength);
  EXPECT_EQ(guess.minimum(false).determination.rank, 5U);
  EXPECT_EQ(guess.minimum(true).determination.rank, 6U);
  EXPECT_LT((guess.from_start(guess.minimum(true).pose) - kTarget).norm(), 1e-9);
}

TEST(PoseEstimate, FindsOutWhatIsDeterminedAgainOnlyWhenAskedOnceAllIs) {
  Guess guess;
  guess.ask_for(kTarget, kStrong);
  guess.estimate.know(guess.minimum());
  EXPECT_TRUE(guess.estimate.determined());
  Vec6 strength = kStrong;
  strength[5] = 1e-6;
  guess.ask_for(kTarget, strength);
  EXPECT_EQ(guess.minimum().determination.rank, 6U);
  guess.estimate.redetermine();
  EXPECT_EQ(guess.minimum().determination.rank, 5U);
}

TEST(PoseEstimate, NeverStepsFartherThanTheReach) {
  Guess guess;
  const double reach = guess.problem.reach();
  for (const double share : {0.5, 0.999, 1.001, 20.0}) {
    const Vec6 target = share * reach * kTarget.normalized();
    guess.ask_for(target, kStrong);
    const Minimum minimum = guess.minimum(true);
    const double wanted = std::min(share, 1.0) * reach;
    EXPECT_NEAR(minimum.step, wanted, 1e-9 * reach) << share;
    EXPECT_LT((guess.from_start(minimum.pose) - wanted * kTarget.normalized()).norm(), 1e-9 * reach) << share;
  }
}

TEST(PoseEstimate, KeepsLockedDegreesOfFreedom) {
  Guess guess(kLockTy | kLockRx);
  guess.ask_for(kTarget, kStrong);
  for (int k = 0; k < 5; ++k) {
    const Minimum minimum = guess.minimum();
    EXPECT_EQ(minimum.determination.locked, 2U);
    EXPECT_EQ(minimum.determination.rank, 6U);
    guess.estimate.know(minimum);
    guess.estimate.move_to(minimum.pose);
  }
  const Pose& pose = guess.estimate.pose();
  EXPECT_NEAR(pose.translation.y(), start_pose().translation.y(), 1e-15);
  EXPECT_NEAR(euler_angles(pose.rotation).psi, euler_angles(start_pose().rotation).psi, 1e-15);
  EXPECT_GT(std::abs(pose.translation.z() - start_pose().translation.z()), 0.1) << "the others move";
  EXPECT_GT(std::abs(euler_angles(pose.rotation).phi - euler_angles(start_pose().rotation).phi), 1e-4);
}

TEST(PoseEstimate, TakesTheStandardDeviationFromWhatIsLeftButNotBelowTheNoise) {
  Guess guess;
  guess.ask_for(kTarget, kStrong, 0.47);
  EXPECT_NEAR(guess.minimum().sigma, std::sqrt(2 * 0.47 / (kCount - 6)), 1e-9);
  guess.ask_for(kTarget, kStrong, 1e-12);
  EXPECT_EQ(guess.minimum().sigma, guess.problem.config.noise_floor_mm);
}

TEST(PoseEstimate, KnowsAllOfAMinimum) {
  Guess guess;
  guess.ask_for(kTarget, without_last(), 0.47);
  const Minimum minimum = guess.minimum();
  guess.estimate.know(minimum);
  EXPECT_EQ(guess.estimate.determination().rank, 5U);
  EXPECT_EQ(guess.estimate.covariance(), minimum.covariance);
  EXPECT_EQ(guess.estimate.sigma(), minimum.sigma);
  EXPECT_EQ(guess.estimate.last_step(), minimum.step);
  guess.estimate.set_last_step(7.0);
  EXPECT_EQ(guess.estimate.last_step(), 7.0);
}

TEST(PoseEstimate, TellsHowUncertainADistanceIs) {
  Guess guess;
  Minimum minimum = guess.minimum();
  minimum.sigma = 0.5;
  minimum.covariance = Mat6::Zero();
  minimum.covariance(5, 5) = 4.0;                        // of the shift along z
  minimum.covariance(1, 1) = 9.0;                        // of the turn about y
  minimum.determination.free_directions = Mat6::Zero();  // the shift along x
  minimum.determination.free_directions(3, 0) = 1.0;
  guess.estimate.know(minimum);
  const MotionFrame& frame = guess.problem.frame;
  const Pose back = {start_pose().rotation.transpose(),
                     -(start_pose().rotation.transpose() * start_pose().translation)};
  Foot foot;
  foot.normal = Vec3::UnitZ();
  const auto at_pivot = guess.estimate.uncertainty_of(apply(back, frame.pivot), foot);
  EXPECT_NEAR(at_pivot.standard, 0.5 * 2.0, 1e-12);
  EXPECT_EQ(at_pivot.undetermined, 0.0);
  const Vec3 far = frame.pivot + frame.length * Vec3::UnitX();  // a turn about y moves it along z
  EXPECT_NEAR(guess.estimate.uncertainty_of(apply(back, far), foot).standard, 0.5 * std::sqrt(4.0 + 9.0), 1e-12);
  foot.normal = Vec3::UnitX();
  EXPECT_NEAR(guess.estimate.uncertainty_of(apply(back, frame.pivot), foot).undetermined,
              tuning::kStartUncertainty * frame.length, 1e-12);
}

}  // namespace
}  // namespace bladefit::testing
