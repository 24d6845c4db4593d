#include "core/inspection/blade_verdict.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace bladefit {
namespace {

/// A good blade, seen whole.
BladeEvidence good() {
  BladeEvidence evidence;
  evidence.converged = evidence.judged = true;
  evidence.determined = 6;
  return evidence;
}

struct Case {
  const char* what;
  void (*change)(BladeEvidence&);
  Reason reason;
};

/// What leaves the fit in doubt, so that nothing is judged.
const std::vector<Case> kDoubts = {
    {"not converged", [](BladeEvidence& e) { e.converged = false; }, Reason::not_converged},
    {"five of six", [](BladeEvidence& e) { e.determined = 5; }, Reason::underdetermined},
    {"a foot unproven", [](BladeEvidence& e) { e.unproven = 1; }, Reason::unproven},
    {"inches", [](BladeEvidence& e) { e.doubts.add(Reason::wrong_units); }, Reason::wrong_units},
    {"mirrored", [](BladeEvidence& e) { e.doubts.add(Reason::mirrored); }, Reason::mirrored},
    {"two blades fit", [](BladeEvidence& e) { e.doubts.add(Reason::ambiguous); }, Reason::ambiguous},
    {"far start", [](BladeEvidence& e) { e.doubts.add(Reason::far_start); }, Reason::far_start},
};

/// What was not seen.
const std::vector<Case> kGaps = {
    {"a record lost", [](BladeEvidence& e) { e.lost = 1; }, Reason::points_lost},
    {"a record refused", [](BladeEvidence& e) { e.refused = 1; }, Reason::points_refused},
    {"a zone missed", [](BladeEvidence& e) { e.zones_missed = 1; }, Reason::zone_not_probed},
    {"a point pending", [](BladeEvidence& e) { e.pending = 1; }, Reason::pending},
    {"a point undecided", [](BladeEvidence& e) { e.undecided = 1; }, Reason::undecided},
    {"not finished", [](BladeEvidence& e) { e.finished = false; }, Reason::unfinished},
};

TEST(BladeVerdict, InToleranceOnlyWhereNothingSpeaksAgainst) {
  const BladeVerdict verdict = judge_blade(good());
  EXPECT_EQ(verdict.state, BladeState::in_tolerance);
  EXPECT_FALSE(verdict.reasons.any());
}

TEST(BladeVerdict, EveryGapAndDoubtAloneForbidsInTolerance) {
  for (const auto& cases : {kDoubts, kGaps}) {
    for (const Case& c : cases) {
      BladeEvidence evidence = good();
      c.change(evidence);
      const BladeVerdict verdict = judge_blade(evidence);
      EXPECT_EQ(verdict.state, BladeState::not_decided) << c.what;
      EXPECT_TRUE(verdict.reasons.has(c.reason)) << c.what;
    }
  }
}

TEST(BladeVerdict, APointOutIsOutOfToleranceUnlessTheFitIsInDoubt) {
  BladeEvidence out = good();
  out.out = 1;
  EXPECT_EQ(judge_blade(out).state, BladeState::out_of_tolerance);
  for (const Case& c : kDoubts) {
    BladeEvidence evidence = out;
    c.change(evidence);
    EXPECT_EQ(judge_blade(evidence).state, BladeState::not_decided) << c.what;
    EXPECT_FALSE(judge_blade(evidence).fit_decided()) << c.what;
  }
  for (const Case& c : kGaps) {
    BladeEvidence evidence = out;
    c.change(evidence);
    EXPECT_EQ(judge_blade(evidence).state, BladeState::out_of_tolerance) << c.what;
    EXPECT_TRUE(judge_blade(evidence).reasons.has(c.reason)) << c.what << ": told all the same";
  }
}

TEST(BladeVerdict, ProvenInfeasibleIsOutOfTolerance) {
  BladeEvidence evidence = good();
  evidence.converged = false;
  evidence.infeasible = true;
  EXPECT_EQ(judge_blade(evidence).state, BladeState::out_of_tolerance);
  EXPECT_FALSE(judge_blade(evidence).reasons.any());
}

TEST(BladeVerdict, LockedDirectionsNeedNoPoints) {
  BladeEvidence evidence = good();
  evidence.determined = evidence.free = 2;
  EXPECT_EQ(judge_blade(evidence).state, BladeState::in_tolerance);
}

TEST(BladeVerdict, WithoutAToleranceNothingIsJudgedButTheReasonsAreTold) {
  BladeEvidence evidence = good();
  evidence.judged = false;
  evidence.pending = 3;
  EXPECT_EQ(judge_blade(evidence).state, BladeState::not_judged);
  EXPECT_TRUE(judge_blade(evidence).fit_decided());
  EXPECT_FALSE(judge_blade(evidence).reasons.has(Reason::pending));
  evidence.converged = false;
  EXPECT_EQ(judge_blade(evidence).state, BladeState::not_judged);
  EXPECT_FALSE(judge_blade(evidence).fit_decided());
}

TEST(BladeVerdict, EveryWordIsAnother) {
  std::vector<std::string> words(kReasonWords.begin(), kReasonWords.end());
  std::ranges::sort(words);
  EXPECT_EQ(std::ranges::adjacent_find(words), words.end());
  EXPECT_EQ(word_of(Reason::not_converged), "not_converged");
  EXPECT_EQ(word_of(Reason::unfinished), "unfinished");
  EXPECT_EQ(word_of(BladeState::not_decided), "not_decided");
}

ToleranceMap two_zones() {
  ToleranceMap map;
  map.box_count = 2;
  map.boxes[0] = {0, 0.4, 0.6, 0.0, 1.0};
  map.boxes[1] = {1, 0.0, 1.0, 0.9, 1.0};
  map.leading_edge_mm = 0.1;
  return map;
}

Verdict verdict_at(PointState state, std::uint32_t patch, double u, double v) {
  Verdict verdict;
  verdict.state = state;
  verdict.foot.patch = patch;
  verdict.foot.u = u;
  verdict.foot.v = v;
  return verdict;
}

TEST(ZoneCount, BoxesOfOneNumberAreOneZone) {
  ToleranceMap map = two_zones();
  map.boxes[0].zone = map.boxes[1].zone = 3;
  map.boxes[2] = {0, 0.4, 0.6, 0.0, 1.0, 0};  // the first one again, by itself
  map.boxes[3] = {0, 0.6, 0.8, 0.0, 1.0, 4};  // they share the limit u = 0.6
  map.boxes[4] = {0, 0.5, 0.6, 0.0, 1.0, 4};
  map.box_count = 5;
  ZoneCount zones(map);
  EXPECT_EQ(zones.missed(), 3U);
  zones.count(verdict_at(PointState::in, 1, 0.5, 0.95), 1);
  EXPECT_EQ(zones.missed(), 2U);
  zones.count(verdict_at(PointState::in, 0, 0.6, 0.2), 1);
  EXPECT_EQ(zones.missed(), 0U);
  EXPECT_EQ(zones.points(0), 2U);
  EXPECT_EQ(zones.points(2), 1U);
  EXPECT_EQ(zones.points(3), 1U) << "on the common limit a point is one point";
}

TEST(ZoneCount, EachZoneNeedsItsOwnJudgedPoints) {
  ToleranceMap map = two_zones();
  ZoneCount zones(map);
  EXPECT_EQ(zones.missed(), 2U);
  zones.count(verdict_at(PointState::in, 0, 0.5, 0.2), 1);
  EXPECT_EQ(zones.missed(), 1U);
  for (const PointState state : {PointState::pending, PointState::rejected, PointState::undecided})
    zones.count(verdict_at(state, 1, 0.5, 0.95), 1);
  EXPECT_EQ(zones.missed(), 1U) << "not judged";
  zones.count(verdict_at(PointState::out, 1, 0.5, 0.95), 1);
  EXPECT_EQ(zones.missed(), 0U);
  map.least_points = 2;
  EXPECT_EQ(zones.missed(), 2U);
  zones.count(verdict_at(PointState::out, 1, 0.5, 0.95), static_cast<std::uint32_t>(-1));
  EXPECT_EQ(zones.points(1), 0U);
}

TEST(ZoneCount, AZoneWithoutAToleranceNeedsNone) {
  ToleranceMap map = two_zones();
  map.leading_edge_mm = std::numeric_limits<double>::infinity();
  EXPECT_EQ(ZoneCount(map).missed(), 0U);
}

}  // namespace
}  // namespace bladefit
