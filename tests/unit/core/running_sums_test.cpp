// The sums that the pose is solved from: every point is in them exactly once.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/localizer_fixtures.hpp"
#include "tests/unit/core/owned_parts.hpp"

namespace bladefit::testing {
namespace {

LocalizerConfig summed_config(std::uint32_t capacity) {
  LocalizerConfig config = config_of(read_case("dtmb4119"), capacity);
  config.edges = EdgePolicy::use;  // so that every point counts
  return config;
}

/// Points that come and go as a localizer has them, at a pose that wanders. Every weight is another one, so that a
/// point that is in the sums twice cannot make up for one that is in none.
class Traffic {
 public:
  Traffic(std::uint32_t capacity, std::uint64_t seed)
      : random_(seed),
        parts_(reference_design("dtmb4119").image(), summed_config(capacity)),
        probes_(points_of(read_case("dtmb4119"), "full")) {}

  [[nodiscard]] int draw(int below) { return std::uniform_int_distribution<int>(0, below - 1)(random_); }

  /// A new point, stored where there is room, else in the place of another one or passing.
  void come() {
    LocalizerParts& p = *parts_;
    ProbePoint probe = probes_[static_cast<std::size_t>(draw(static_cast<int>(probes_.size())))];
    probe.sequence = ++came_;
    probe.weight = std::exp(uniform(random_, -2.0, 2.0));
    weight_ += probe.weight;
    StoredPoint point = p.finder.new_point(probe, {});
    newest_ = p.finder.find(point, p.estimate.pose(), Search::always);
    std::uint32_t index = p.store.size();
    if (!p.store.full()) {
      p.store.append(point);
    } else {
      if (draw(2) == 0) index = p.store.next_to_evict([](std::uint32_t) { return false; });
      if (index == p.store.size()) return p.sums.take_in_passing(point, newest_, p.estimate.pose());
      p.sums.evict(p.store[index], index, p.estimate.pose());
      p.store.replace(index, point);
    }
    p.store.record(p.store[index], newest_, p.estimate.revision());
    p.sums.take_in(p.store, index, p.estimate);
  }

  /// What a push does with a point that was measured again.
  [[nodiscard]] auto review() {
    return [this](std::uint32_t index, const Measurement& m) {
      parts_->store.record(parts_->store[index], m, parts_->estimate.revision());
    };
  }

  void settle() { parts_->sums.settle(parts_->store, parts_->estimate); }
  bool refresh(std::uint32_t budget) { return parts_->sums.refresh(parts_->store, parts_->estimate, budget, review()); }
  void gather(std::uint32_t newest_sequence) {
    parts_->sums.gather(parts_->store, parts_->estimate.pose(), newest_sequence, newest_, review());
  }
  void wander(double length) {
    Vec6 x;
    for (int k = 0; k < 6; ++k) x[k] = uniform(random_, -length, length);
    parts_->estimate.move_to(moved(parts_->estimate.pose(), x, parts_->problem.frame));
  }

  /// As a refinement begins; its sweep may be left unfinished.
  void refine(std::uint32_t visited) {
    parts_->sums.settle_all(parts_->store, parts_->estimate);
    parts_->sums.begin_sweep(parts_->estimate.pose());
    for (std::uint32_t i = 0; i < std::min(visited, parts_->store.size()); ++i) {
      StoredPoint& point = parts_->store[i];
      const Measurement m = parts_->finder.find(point, parts_->estimate.pose(), Search::if_doubtful);
      parts_->store.record(point, m, parts_->estimate.revision());
      parts_->sums.sweep_over(point, m, parts_->finder.row(m, Vec6::Zero()));
    }
    if (parts_->sums.cursor() == parts_->store.size()) {
      parts_->sums.commit();
      parts_->sums.begin_sweep(parts_->estimate.pose());
    }
  }
  /// As a point that is staged: it never becomes recent.
  void settle_all() {
    parts_->sums.settle_all(parts_->store, parts_->estimate);
    if (parts_->sums.cursor() > 0) parts_->sums.begin_sweep(parts_->estimate.pose());
  }

  void expect_each_once(const char* after) {
    const QuadraticModel& model = parts_->sums.model();
    ASSERT_EQ(model.count, came_) << after;
    ASSERT_NEAR(model.weight, weight_, 1e-10 * weight_) << after;
    ASSERT_EQ(parts_->sums.region(Region::rest).count + parts_->sums.region(Region::leading_edge).count, came_);
  }

  [[nodiscard]] std::uint32_t came() const { return came_; }
  [[nodiscard]] OwnedParts& parts() { return parts_; }

 private:
  std::mt19937_64 random_;
  OwnedParts parts_;
  std::vector<ProbePoint> probes_;
  Measurement newest_;
  std::uint32_t came_ = 0;
  double weight_ = 0;
};

void expect_near(const QuadraticModel& sums, const QuadraticModel& wanted) {
  EXPECT_EQ(sums.count, wanted.count);
  EXPECT_TRUE(same_bits(sums.reference, wanted.reference));
  EXPECT_NEAR(sums.weight, wanted.weight, 1e-12 * wanted.weight);
  EXPECT_NEAR(sums.half_square, wanted.half_square, 1e-10 * wanted.half_square);
  EXPECT_LT((sums.gauss - wanted.gauss).norm(), 1e-12 * wanted.gauss.norm());
  EXPECT_LT((sums.bend - wanted.bend).norm(), 1e-8 * wanted.bend.norm());
  EXPECT_LT((sums.gradient - wanted.gradient).norm(), 1e-10 * wanted.gradient.norm());
}

/// The sums over all stored points at the present pose, from scratch.
QuadraticModel from_scratch(LocalizerParts& p) {
  QuadraticModel model;
  model.reference = p.estimate.pose();
  for (std::uint32_t i = 0; i < p.store.size(); ++i) {
    const Measurement m = p.finder.find(p.store[i], p.estimate.pose(), Search::always);
    if (p.selection.left_out(p.store[i], m.foot)) continue;
    const DistanceRow row = distance_row(m.projection(), m.foot, m.r, Vec6::Zero(), p.problem.frame);
    model.add(row, Vec6::Zero(), p.store[i].weight, loss_terms(Loss::none, 0.0, m.foot.distance));
  }
  return model;
}

/// One event of a random kind, with the points counted afterwards.
void happen(Traffic& traffic) {
  switch (traffic.draw(12)) {
    case 0:
      traffic.settle_all();
      return traffic.expect_each_once("settle_all");
    case 1: {
      const bool whole = traffic.draw(2) == 0;
      traffic.refine(whole ? 1000 : static_cast<std::uint32_t>(traffic.draw(40)));
      return traffic.expect_each_once(whole ? "a sweep" : "a piece of a sweep");
    }
    case 2:
      traffic.refresh(static_cast<std::uint32_t>(traffic.draw(70)));
      traffic.gather(0);
      return traffic.expect_each_once("refresh");
    case 3:
      traffic.settle();
      traffic.gather(0);
      return traffic.expect_each_once("settle");
    default:
      traffic.wander(0.05);
      traffic.come();
      if (traffic.draw(3) > 0) traffic.settle();
      if (traffic.draw(3) > 0) traffic.refresh(static_cast<std::uint32_t>(traffic.draw(12)));
      traffic.gather(traffic.came());
      return traffic.expect_each_once("a new point");
  }
}

TEST(RunningSums, HoldEveryPointOnceWhateverHappens) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Traffic traffic(40, seed);
    for (int k = 0; k < 250; ++k) {
      happen(traffic);
      if (::testing::Test::HasFatalFailure()) return;
    }
    EXPECT_GT(traffic.came(), 100U) << "more than there are places";
  }
}

TEST(RunningSums, OfARefinementsSweepAreThoseFromScratch) {
  Traffic traffic(60, 7);
  for (int k = 0; k < 50; ++k) traffic.come();
  traffic.wander(0.05);
  traffic.refine(1000);
  expect_near(traffic.parts()->sums.model(), from_scratch(*traffic.parts()));
}

TEST(RunningSums, OfAStreamsSweepAreThoseFromScratch) {
  Traffic traffic(60, 8);
  for (int k = 0; k < 50; ++k) {
    traffic.come();
    traffic.wander(0.01);
    traffic.settle();
  }
  int sweeps = 0;
  while (sweeps < 2) sweeps += traffic.refresh(7) ? 1 : 0;  // the second one begins at this pose
  traffic.gather(0);
  expect_near(traffic.parts()->sums.model(), from_scratch(*traffic.parts()));
}

TEST(RunningSums, LeaveOutWhatDoesNotCount) {
  LocalizerConfig config = config_of(read_case("dtmb4119"), 80);
  config.window_low = 0.2;
  config.window_high = 0.8;
  OwnedParts parts(reference_design("dtmb4119").image(), config);
  parts.store(thinned(read_case("dtmb4119"), 0, 25));
  parts.sweep();
  std::uint32_t counted = 0;
  for (std::uint32_t i = 0; i < parts->store.size(); ++i) {
    if (!parts->selection.left_out(parts->store[i], parts->store[i].foot)) ++counted;
  }
  EXPECT_LT(counted, parts->store.size() - 10);
  EXPECT_GT(counted, 10U);
  EXPECT_EQ(parts->sums.model().count, counted);
}

TEST(RunningSums, KeepTheNewestFewRecentAndContestedOnesToo) {
  Traffic traffic(60, 9);
  PointStore& store = traffic.parts()->store;
  for (std::uint32_t k = 0; k < 10; ++k) {
    traffic.come();
    store[k].runner_up.margin = k == 2 ? 0.0 : traffic.parts()->problem.frame.length;
  }
  EXPECT_TRUE(traffic.parts()->sums.contested(store[2]));
  EXPECT_FALSE(traffic.parts()->sums.contested(store[3]));
  traffic.settle();
  for (std::uint32_t k = 0; k < 10; ++k) {
    EXPECT_EQ(store[k].recent, k == 2 || k >= 10 - tuning::kNewestRecent) << k;
  }
  traffic.settle_all();
  for (std::uint32_t k = 0; k < 10; ++k) EXPECT_FALSE(store[k].recent) << k;
}

TEST(RunningSums, KeepNoMoreRecentPointsThanThereIsRoom) {
  Traffic traffic(60, 10);
  for (int k = 0; k < 40; ++k) {
    traffic.come();
    traffic.parts()->store[static_cast<std::uint32_t>(k)].runner_up.margin = 0.0;  // all are contested
    traffic.settle();
    traffic.gather(traffic.came());
    traffic.expect_each_once("a contested point");
    std::uint32_t recent = 0;
    for (std::uint32_t i = 0; i < traffic.parts()->store.size(); ++i) recent += traffic.parts()->store[i].recent;
    ASSERT_LE(recent, tuning::kRecentPlaces);
  }
}

TEST(RunningSums, MeasureHowFarThePoseHasMovedSinceTheyWereBegun) {
  Traffic traffic(60, 11);
  for (int k = 0; k < 20; ++k) traffic.come();
  traffic.refine(1000);
  LocalizerParts& p = *traffic.parts();
  EXPECT_EQ(p.sums.moved_to(p.estimate.pose()), 0.0);
  EXPECT_NEAR(p.sums.moved_to(moved(p.estimate.pose(), 0.3 * Vec6::Unit(4), p.problem.frame)), 0.3, 1e-12);
}

TEST(RunningSums, ForgetEverythingWhenCleared) {
  Traffic traffic(60, 12);
  for (int k = 0; k < 20; ++k) traffic.come();
  traffic.gather(traffic.came());
  const Pose elsewhere = moved(Pose(), Vec6::Unit(3), traffic.parts()->problem.frame);
  traffic.parts()->sums.clear(elsewhere);
  EXPECT_EQ(traffic.parts()->sums.model().count, 0U);
  EXPECT_TRUE(same_bits(traffic.parts()->sums.model().reference, elsewhere));
  traffic.gather(0);
  EXPECT_EQ(traffic.parts()->sums.model().count, 0U) << "no recent point is left";
}

TEST(RegionSums, KeepTheWorstDistanceWithItsSign) {
  RegionSums sums;
  sums.add(0.0, 5);
  EXPECT_EQ(sums.worst_sequence, 5U);
  sums.add(-0.3, 6);
  sums.add(0.2, 7);
  sums.add(0.3, 8);
  EXPECT_EQ(sums.worst, -0.3);
  EXPECT_EQ(sums.worst_sequence, 6U) << "the first of two";
  EXPECT_EQ(sums.count, 4U);
  EXPECT_NEAR(sums.square, 0.09 + 0.04 + 0.09, 1e-15);
}

}  // namespace
}  // namespace bladefit::testing
