// The search from further starts by itself.

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/localizer_fixtures.hpp"
#include "tests/unit/core/owned_parts.hpp"

namespace bladefit::testing {
namespace {

using Outcome = FurtherStarts::Outcome;

constexpr double kNone = std::numeric_limits<double>::infinity();

LocalizerConfig started_config() {
  LocalizerConfig config = config_of(read_case("dtmb4119"), 60);
  config.mode = FitMode::minimax;
  config.further_starts = 2;
  return config;
}

/// Points at their least-squares optimum, and a search about that.
struct Sought {
  Sought()
      : parts(reference_design("dtmb4119").image(), started_config()),
        rows(BoundRows::doubles_for(60)),
        places(60),
        program(parts->problem, parts->plan),
        starts(parts->problem, parts->plan, parts->finder, parts->selection) {
    program.attach(rows.data(), 60);
    sheets.attach(places.data());
    parts.store(thinned(read_case("dtmb4119"), 0, 45));
    parts.fit();
    parts->selection.hold(parts->store);
    (void)program.assign_regions(parts->store, parts->verdicts);
    starts.plan(parts->estimate.pose(), parts->sums.model());
  }
  void begin(double own_value) { starts.begin(own_value, parts->estimate.pose(), parts->store.size(), program); }
  [[nodiscard]] Outcome finish() {
    Outcome outcome = Outcome::running;
    for (int k = 0; outcome == Outcome::running && k < 100000; ++k) {
      EXPECT_FALSE(starts.done());
      outcome = starts.advance(parts->store, parts->sums.model(), program, sheets);
    }
    return outcome;
  }

  OwnedParts parts;
  std::vector<double> rows;
  std::vector<KeptPlaces> places;
  KeptSheets sheets;
  ModeProgram program;
  FurtherStarts starts;
};

TEST(FurtherStarts, ChangeNeitherThePoseNorAPoint) {
  Sought search;
  const Pose pose = search.parts->estimate.pose();
  const std::uint32_t searches = search.parts->store.searches();
  std::vector<Foot> feet;
  for (std::uint32_t i = 0; i < search.parts->store.size(); ++i) feet.push_back(search.parts->store[i].foot);
  search.begin(kNone);
  EXPECT_EQ(search.finish(), Outcome::better) << "than none";
  EXPECT_TRUE(same_bits(search.parts->estimate.pose(), pose));
  for (std::uint32_t i = 0; i < search.parts->store.size(); ++i) {
    EXPECT_EQ(search.parts->store[i].foot.u, feet[i].u);
    EXPECT_EQ(search.parts->store[i].foot.distance, feet[i].distance);
  }
  EXPECT_GT(search.parts->store.searches(), searches) << "but the searches are counted";
}

TEST(FurtherStarts, FindABetterOptimumThanABadOneAndNoneBetterThanAPerfectOne) {
  Sought search;
  search.begin(1e3);
  EXPECT_EQ(search.finish(), Outcome::better);
  EXPECT_TRUE(search.starts.done());
  EXPECT_GE(search.starts.same(), 1U);
  EXPECT_LE(search.starts.same(), 2U);
  EXPECT_FALSE(same_bits(search.starts.best_pose(), search.starts.own_pose()));
  search.starts.restart();
  EXPECT_FALSE(search.starts.done());
  EXPECT_EQ(search.starts.same(), 0U);
  search.begin(1e-6);
  EXPECT_EQ(search.finish(), Outcome::not_better);
  EXPECT_EQ(search.starts.same(), 0U);
}

TEST(FurtherStarts, GoBackOnceToAnOptimumThatWasFoundBefore) {
  Sought search;
  EXPECT_FALSE(search.starts.go_back()) << "nothing was sought";
  search.begin(1e3);
  EXPECT_FALSE(search.starts.go_back()) << "they are under way";
  (void)search.finish();
  EXPECT_TRUE(search.starts.found_before());
  EXPECT_EQ(search.starts.own_value(), 1e3);
  EXPECT_TRUE(search.starts.go_back());
  EXPECT_TRUE(search.starts.done());
  EXPECT_EQ(search.starts.same(), 0U) << "no start led to that one";
  EXPECT_FALSE(search.starts.go_back());
}

TEST(FurtherStarts, DoNotGoBackToNothing) {
  Sought search;
  search.begin(kNone);
  (void)search.finish();
  EXPECT_FALSE(search.starts.found_before());
  EXPECT_FALSE(search.starts.go_back());
}

TEST(FurtherStarts, AreGivenUpWhileUnderWayButKeptOnceDone) {
  Sought search;
  search.begin(1e3);
  (void)search.starts.advance(search.parts->store, search.parts->sums.model(), search.program, search.sheets);
  search.starts.interrupt();
  EXPECT_FALSE(search.starts.done());
  search.begin(1e3);
  (void)search.finish();
  search.starts.interrupt();
  EXPECT_TRUE(search.starts.done());
}

}  // namespace
}  // namespace bladefit::testing
