// Points that keep their sheets while a program runs, and the descent over poses whose feet are those of the
// conventions.

#include <gtest/gtest.h>

#include "core/fit/existence_row.hpp"
#include "core/fit/facing_row.hpp"
#include "tests/support/localizer_fixtures.hpp"
#include "tests/unit/core/owned_parts.hpp"

namespace bladefit::testing {
namespace {

using Weighed = SheetDescent::Outcome;

constexpr std::uint32_t kDescending = 60;

LocalizerConfig descending_config() {
  LocalizerConfig config = config_of(read_case("dtmb4119"), kDescending);
  config.mode = FitMode::minimax;
  return config;
}

/// Points at their least-squares optimum, and the program of their minimax.
struct Descending {
  Descending()
      : parts(reference_design("dtmb4119").image(), descending_config()),
        rows(BoundRows::doubles_for(kDescending)),
        places(kDescending),
        program(parts->problem, parts->plan),
        descent(parts->problem) {
    program.attach(rows.data(), kDescending);
    descent.attach(places.data());
    parts.store(thinned(read_case("dtmb4119"), 0, 45));
    parts.fit();
    parts->selection.hold(parts->store);
    (void)program.assign_regions(parts->store, parts->verdicts);
    program.begin(FitMode::minimax, parts->store.size());
    descent.begin(parts->store, false);
    pose = parts->estimate.pose();
  }

  /// A sweep at the pose that keeps every sheet, or one that searches every foot and finds the same ones.
  void sweep(bool proof = false) {
    program.set_pose(pose);
    descent.begin_sweep(proof, program);
    for (std::uint32_t i = 0; i < parts->store.size(); ++i) note(i, false);
  }
  /// `farther`: by so much than where it is kept lies the foot that is found [mm].
  void note(std::uint32_t i, bool other, double farther = 0.0) {
    const StoredPoint& point = parts->store[i];
    Measurement m = parts->finder.find_from({descent.kept(i), Search::keep}, point, pose);
    m.changed = other;
    m.foot.distance += farther;
    const bool counts = !parts->selection.left_out(point, m.foot);
    descent.note(i, point, pose, m, counts, program);
    if (!counts) return program.skip_row(i);
    program.set_row(i, parts->finder.row(m, Vec6::Zero()));
  }
  [[nodiscard]] Weighed weigh(double merit) { return descent.weigh(merit, pose, parts->store.size()); }
  /// The same after a search that found another foot of point 3.
  [[nodiscard]] Weighed weigh_other(double merit) {
    sweep(true);
    note(3, true);
    return weigh(merit);
  }
  void shift(double x_mm) { pose.translation.x() += x_mm; }
  [[nodiscard]] Vec3 kept_place(std::uint32_t i) const { return {descent.kept(i).u, descent.kept(i).v, 0.0}; }

  OwnedParts parts;
  std::vector<double> rows;
  std::vector<KeptPlaces> places;
  ModeProgram program;
  SheetDescent descent;
  Pose pose;
};

TEST(SheetDescent, NoStepThatIsAcceptedRaisesTheMerit) {
  Descending d;
  double last = std::numeric_limits<double>::infinity();
  Pose from = d.pose;
  int accepted = 0;
  bool settled = false;
  for (int k = 0; k < 60 && !settled; ++k) {
    d.sweep();
    const double merit = d.program.merit(d.parts->sums.model());
    const BoundedFit::Step step = d.program.step(d.parts->sums.model());
    ASSERT_EQ(step.status, Status::ok);
    if (!step.from_last) {
      EXPECT_LE(merit, last * (1.0 + 1e-9)) << "sweep " << k;
      last = merit;
      from = d.pose;
      d.descent.accept(d.parts->store.size());
      ++accepted;
    }
    settled = step.settled;
    d.pose = d.parts->problem.moved_and_held(from, step.x);
  }
  EXPECT_TRUE(settled);
  EXPECT_GT(accepted, 2);
}

TEST(SheetDescent, TracksFromWhatIsKeptUntilAStepIsAccepted) {
  Descending d;
  d.sweep();
  d.descent.accept(d.parts->store.size());
  const Vec3 before = d.kept_place(7);
  d.shift(0.2);
  d.sweep();
  EXPECT_EQ(d.kept_place(7), before) << "a pose is tried";
  d.descent.accept(d.parts->store.size());
  EXPECT_NE(d.kept_place(7), before) << "and counts";
}

TEST(SheetDescent, OtherFeetCountWhereTheMeritHasFallen) {
  Descending d;
  d.sweep();
  EXPECT_EQ(d.weigh(1.0), Weighed::same) << "the first pose";
  const Pose first = d.pose;
  d.shift(0.1);
  d.sweep();
  EXPECT_EQ(d.weigh(7.0), Weighed::same) << "nothing was sought";
  EXPECT_TRUE(same_bits(d.descent.proven_pose(), first));
  EXPECT_EQ(d.weigh_other(0.9), Weighed::adopted);
  EXPECT_TRUE(same_bits(d.descent.proven_pose(), d.pose));
  d.sweep(true);
  EXPECT_EQ(d.weigh(0.8), Weighed::same) << "all are those of before";
}

TEST(SheetDescent, GoesBackAndHoldsFeetThatWouldRaiseTheMerit) {
  Descending d;
  d.sweep();
  (void)d.weigh(1.0);
  d.descent.accept(d.parts->store.size());
  const Pose proven = d.pose;
  const Vec3 place = d.kept_place(3);
  d.shift(0.1);
  EXPECT_EQ(d.weigh_other(1.5), Weighed::back);
  EXPECT_TRUE(same_bits(d.descent.proven_pose(), proven));
  EXPECT_EQ(d.kept_place(3), place);
  d.pose = proven;
  d.sweep();
  EXPECT_DOUBLE_EQ(d.program.merit(d.parts->sums.model()), d.program.value()) << "nothing is broken there";

  EXPECT_EQ(d.weigh_other(1.5), Weighed::back) << "it is held already: nothing is held any more";
  EXPECT_EQ(d.weigh_other(1.5), Weighed::adopted) << "whatever it costs";
  d.sweep(true);
  EXPECT_EQ(d.weigh(1.2), Weighed::stuck) << "worse than where it began";
  EXPECT_EQ(d.descent.let_go(d.parts->store.size()), Weighed::stuck) << "once only";
}

/// Where other feet count at the same merit, the program comes back to the same pose for ever.
TEST(SheetDescent, HoldsFeetThatLeaveTheMeritAsItIs) {
  Descending d;
  d.sweep();
  (void)d.weigh(2.0);
  d.shift(0.1);
  EXPECT_EQ(d.weigh_other(1.0), Weighed::adopted);
  EXPECT_EQ(d.weigh_other(1.0), Weighed::back);
  EXPECT_EQ(d.weigh_other(1.0), Weighed::back) << "nothing is held any more";
  EXPECT_EQ(d.weigh_other(1.5), Weighed::adopted);
  EXPECT_EQ(d.weigh_other(1.5), Weighed::stuck) << "it has come back to the same merit";
}

/// A held foot that tracking loses is another one: the pose is refused. One that a search finds elsewhere is weighed.
TEST(SheetDescent, ASearchMayFindAHeldFootElsewhere) {
  Descending d;
  d.sweep();
  (void)d.weigh(1.0);
  EXPECT_EQ(d.weigh_other(1.5), Weighed::back);
  d.sweep();
  d.descent.accept(d.parts->store.size());
  const auto merit = [&d](bool proof, bool other) {
    d.sweep(proof);
    d.note(3, other, 5.0);
    return d.program.merit(d.parts->sums.model());
  };
  EXPECT_EQ(merit(false, true), std::numeric_limits<double>::infinity());
  EXPECT_EQ(merit(true, false), std::numeric_limits<double>::infinity());
  EXPECT_LT(merit(true, true), std::numeric_limits<double>::infinity());
  EXPECT_EQ(d.weigh(0.9), Weighed::adopted);
  d.sweep();
  d.note(3, false, 10.0);
  EXPECT_LT(d.program.merit(d.parts->sums.model()), std::numeric_limits<double>::infinity()) << "not held any more";
}

TEST(SheetDescent, EndsHoweverOftenFeetChange) {
  Descending d;
  d.sweep();
  (void)d.weigh(1.0);
  int rounds = 0;
  for (Weighed outcome = Weighed::same; outcome != Weighed::stuck && rounds < 1000; ++rounds) {
    d.sweep(true);
    d.note(static_cast<std::uint32_t>(rounds) % 50, true);
    outcome = d.weigh(2.0 + 1e-3 * rounds);
  }
  EXPECT_LT(rounds, 100);
}

/// A limit is a condition that the program's solution keeps.
TEST(SheetDescent, AProgramKeepsItsLimits) {
  Descending d;
  d.sweep();
  const double value = d.program.value();
  const BoundedFit::Step free = d.program.step(d.parts->sums.model());
  ASSERT_EQ(free.status, Status::ok);
  const Vec6 along = free.x.normalized();
  d.program.begin(FitMode::minimax, d.parts->store.size());
  d.sweep();
  d.program.set_limits(1);
  d.program.set_limit(0, -0.25 * free.x.norm(), along);
  const BoundedFit::Step held = d.program.step(d.parts->sums.model());
  ASSERT_EQ(held.status, Status::ok);
  EXPECT_NEAR(held.x.dot(along), 0.25 * free.x.norm(), 1e-9);
  EXPECT_EQ(d.program.held_feet(), 1U);
  d.program.set_limit(0, 0.5, along);
  const double cost = d.program.merit(d.parts->sums.model()) - value;
  EXPECT_GT(cost, 0.0) << "one that is broken costs";
  d.sweep();
  d.program.set_limits(1);
  d.program.set_limit(0, -10.0, along);
  ASSERT_EQ(d.program.step(d.parts->sums.model()).status, Status::ok);
  d.program.set_limit(0, 0.5, along);
  EXPECT_NEAR(d.program.merit(d.parts->sums.model()) - value, 0.5 * cost, 1e-9 * cost) << "less where none rests on it";
}

TEST(FacingRow, AgreesWithDifferences) {
  Descending d;
  const MotionFrame& frame = d.parts->problem.frame;
  int looked = 0;
  for (std::uint32_t i = 0; i < d.parts->store.size(); i += 3) {
    const StoredPoint& point = d.parts->store[i];
    const auto facing_at = [&](const Vec6& x) {
      const Pose pose = moved(d.pose, x, frame);
      const Measurement m = d.parts->finder.find_from({place_of(point), Search::keep}, point, pose);
      return facing_row(m.projection(), m.foot.normal, m.r, pose.rotation * point.approach, frame);
    };
    if (d.parts->finder.find(point, d.pose, Search::keep).foot.kind != FootKind::interior) continue;
    const FacingRow row = facing_at(Vec6::Zero());
    for (int k = 0; k < 6; ++k) {
      constexpr double kStep = 1e-5;
      const double difference = (facing_at(kStep * Vec6::Unit(k)).facing - facing_at(-kStep * Vec6::Unit(k)).facing);
      EXPECT_NEAR(row.gradient[k], difference / (2.0 * kStep), 1e-4 * (1.0 + row.gradient.norm())) << i << " " << k;
    }
    ++looked;
  }
  EXPECT_GT(looked, 10);
}

TEST(ExistenceRow, AgreesWithDifferences) {
  Descending d;
  const FitProblem& problem = d.parts->problem;
  int looked = 0;
  for (std::uint32_t i = 0; i < d.parts->store.size(); i += 3) {
    StoredPoint point = d.parts->store[i];
    const Measurement there = d.parts->finder.find(point, d.pose, Search::keep);
    if (there.foot.kind != FootKind::interior) continue;
    const Vec3 foot = there.foot.point, normal = there.foot.normal;
    const auto row_at = [&](double height, const Vec6& x) {
      const Vec3 r = foot + height * normal;
      Projection projection = project_local(problem.surface, r, there.place);
      const Vec3 moved_r = apply(moved(Pose(), x, problem.frame), r);
      projection = project_local(problem.surface, moved_r, projection.place);
      return existence_row(problem.surface, projection, foot_of(problem.surface, projection, 0.0).normal, moved_r,
                           problem.frame);
    };
    EXPECT_NEAR(row_at(0.0, Vec6::Zero()).existence, 1.0, 1e-9) << "on the surface";
    const double height = -0.005 * problem.frame.length;
    const ExistenceRow row = row_at(height, Vec6::Zero());
    if (!(row.existence > 0.5)) continue;  // near the centre of curvature, or beyond it on another sheet
    for (int k = 0; k < 6; ++k) {
      constexpr double kStep = 1e-4;
      const double above = row_at(height, kStep * Vec6::Unit(k)).existence;
      const double below = row_at(height, -kStep * Vec6::Unit(k)).existence;
      EXPECT_NEAR(row.gradient[k], (above - below) / (2.0 * kStep), 1e-4 * (1.0 + row.gradient.norm()))
          << i << " " << k;
    }
    ++looked;
  }
  EXPECT_GT(looked, 10);
}

}  // namespace
}  // namespace bladefit::testing
