// Places of points and their order by sequence.

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/core/owned_parts.hpp"

namespace bladefit::testing {
namespace {

constexpr auto in_use_are_none = [](std::uint32_t) { return false; };

/// A store of so many points of this region, with the sequences 1, 2, 3...
void fill(PointStore& store, std::uint32_t count, Region region) {
  for (std::uint32_t k = 1; k <= count; ++k) {
    StoredPoint point = numbered(k);
    point.region = region;
    store.append(point);
  }
}

TEST(PointStore, FindsTheFirstAndTheLastPointAndNoneThatIsMissing) {
  OwnedStore store(5);
  EXPECT_EQ(store.find(1), 0U) << "size() of an empty store";
  for (const std::uint32_t sequence : {3U, 7U, 9U, 12U}) store.append(numbered(sequence));
  EXPECT_EQ(store.find(3), 0U);
  EXPECT_EQ(store.find(9), 2U);
  EXPECT_EQ(store.find(12), 3U);
  for (const std::uint32_t missing : {0U, 1U, 8U, 13U}) EXPECT_EQ(store.find(missing), store.size()) << missing;
}

TEST(PointStore, IsFullWhenEveryPlaceIsTaken) {
  OwnedStore store(2);
  EXPECT_EQ(store.append(numbered(1)), 0U);
  EXPECT_FALSE(store.full());
  EXPECT_EQ(store.append(numbered(2)), 1U);
  EXPECT_TRUE(store.full());
  EXPECT_EQ(store.size(), 2U);
}

TEST(PointStore, FindsEveryPointInItsPlaceHoweverOftenPlacesAreTaken) {
  constexpr std::uint32_t kPlaces = 8;
  std::mt19937_64 random(5);
  OwnedStore store(kPlaces);
  std::vector<std::uint32_t> held;
  std::uint32_t newest = 0;
  for (int k = 0; k < 300; ++k) {
    newest += std::uniform_int_distribution<std::uint32_t>(1, 3)(random);
    if (held.size() < kPlaces && (held.empty() || random() % 2 == 0)) {
      EXPECT_EQ(store.append(numbered(newest)), held.size());
      held.push_back(newest);
    } else {
      const auto place = static_cast<std::uint32_t>(random() % held.size());
      const std::uint32_t gone = held[place];
      store.replace(place, numbered(newest));
      held[place] = newest;
      EXPECT_EQ(store.find(gone), store.size());
    }
    for (std::uint32_t i = 0; i < held.size(); ++i) ASSERT_EQ(store.find(held[i]), i);
  }
}

TEST(PointStore, GivesUpOnlyAPointOfTheRestThatNothingWaitsFor) {
  OwnedStore store(6);
  fill(store, 6, Region::rest);
  store[0].region = Region::leading_edge;
  store[1].recent = true;
  store[2].queued = true;
  const auto third = [](std::uint32_t index) { return index == 3; };
  EXPECT_EQ(store.next_to_evict(third), 4U);
  EXPECT_EQ(store.next_to_evict(third), 5U) << "not the same one again";
  EXPECT_EQ(store.next_to_evict(third), 4U) << "round from the end";
}

TEST(PointStore, LooksAtAFewPointsForOneToGiveUpAndGoesOnFromThere) {
  OwnedStore store(2 * tuning::kEvictionLooks);
  fill(store, 2 * tuning::kEvictionLooks, Region::leading_edge);
  store[tuning::kEvictionLooks + 5].region = Region::rest;
  std::uint32_t looks = 0;
  const auto counting = [&looks](std::uint32_t) {
    ++looks;
    return false;
  };
  EXPECT_EQ(store.next_to_evict(counting), store.size());
  EXPECT_EQ(looks, tuning::kEvictionLooks);
  EXPECT_EQ(store.next_to_evict(counting), tuning::kEvictionLooks + 5);
}

TEST(PointStore, RecordsTheFootAndKeepsTheRunnerUpUnlessAnotherIsKnown) {
  OwnedStore store(1);
  StoredPoint point = numbered(1);
  point.runner_up.margin = 4.0;
  point.ranked_at = {1, 2, 3};
  Measurement m;
  m.foot = foot_at(0.3, 0.1);
  m.place.span = 7;
  m.r = {4, 5, 6};
  m.runner_up.margin = 9.0;
  store.record(point, m, 11);
  EXPECT_EQ(point.foot.u, 0.3);
  EXPECT_EQ(point.span, 7U);
  EXPECT_EQ(point.revision, 11U);
  EXPECT_EQ(point.runner_up.margin, 4.0);
  EXPECT_EQ(point.ranked_at, Vec3(1, 2, 3));
  m.ranked = true;
  store.record(point, m, 12);
  EXPECT_EQ(point.runner_up.margin, 9.0);
  EXPECT_EQ(point.ranked_at, m.r);
}

TEST(PointStore, CountsSearchesWhetherRecordedOrNot) {
  OwnedStore store(1);
  StoredPoint point;
  Measurement m;
  store.record(point, m, 0);
  EXPECT_EQ(store.searches(), 0U) << "a foot that was tracked";
  m.searched = true;
  store.record(point, m, 0);
  store.count_search();
  EXPECT_EQ(store.searches(), 2U);
}

TEST(PointStore, ForgetsEverythingWhenCleared) {
  OwnedStore store(4);
  fill(store, 4, Region::rest);
  store.count_search();
  EXPECT_EQ(store.next_to_evict(in_use_are_none), 0U);
  store.replace(0, numbered(5));
  store.clear();
  EXPECT_EQ(store.size(), 0U);
  EXPECT_EQ(store.searches(), 0U);
  EXPECT_EQ(store.find(5), 0U);
  store.append(numbered(1));
  EXPECT_EQ(store.find(3), 1U) << "size(), although it was there before";
  store.clear();
  fill(store, 4, Region::rest);
  EXPECT_EQ(store.next_to_evict(in_use_are_none), 0U);
}

}  // namespace
}  // namespace bladefit::testing
