// What a search from further starts knows of where these have come to rest.

#include "core/localizer/known_rests.hpp"

#include <gtest/gtest.h>

namespace bladefit::testing {
namespace {

TEST(KnownRests, TellWhatCameOfAValue) {
  KnownRests rests;
  EXPECT_EQ(rests.outcome_of(1.0), nullptr);
  rests.begin_start();
  rests.note(1.0);
  rests.came_to(1.5);
  ASSERT_NE(rests.outcome_of(1.0 + 1e-9), nullptr);
  EXPECT_EQ(*rests.outcome_of(1.0 + 1e-9), 1.5);
  EXPECT_EQ(rests.outcome_of(1.0 + 1e-6), nullptr) << "another optimum";
  EXPECT_EQ(rests.outcome_of(1.5), nullptr) << "no start came to rest there";
}

TEST(KnownRests, AStartThatGoesOnChangesWhatCameOfItsOwnAlone) {
  KnownRests rests;
  rests.begin_start();
  rests.note(1.0);
  rests.came_to(1.5);
  rests.begin_start();
  rests.note(2.0);
  rests.came_to(2.5);
  rests.note(1.8);
  rests.came_to(1.9);
  ASSERT_NE(rests.outcome_of(2.0), nullptr);
  EXPECT_EQ(*rests.outcome_of(1.0), 1.5);
  EXPECT_EQ(*rests.outcome_of(2.0), 1.9);
  EXPECT_EQ(*rests.outcome_of(1.8), 1.9);
  rests.clear();
  EXPECT_EQ(rests.outcome_of(1.0), nullptr);
}

TEST(KnownRests, ForgetWhatIsTooMuch) {
  KnownRests rests;
  for (int k = 1; k <= 1000; ++k) rests.note(k);
  EXPECT_NE(rests.outcome_of(1.0), nullptr);
  EXPECT_EQ(rests.outcome_of(1000.0), nullptr);
}

}  // namespace
}  // namespace bladefit::testing
