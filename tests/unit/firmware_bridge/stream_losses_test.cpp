#include "firmware_bridge/host/threads/stream_losses.hpp"

#include <gtest/gtest.h>

namespace bladefit {
namespace {

StreamEvent event(EventKind kind, std::uint32_t sequence = 0) {
  StreamEvent made{kind, {}};
  made.point.sequence = sequence;
  return made;
}

TEST(StreamLosses, AJumpOfTheSequenceIsALoss) {
  StreamLosses losses;
  EXPECT_FALSE(losses.take(event(EventKind::point, 1)));
  const auto lost = losses.take(event(EventKind::point, 5));
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->first, 2U);
  EXPECT_EQ(lost->last, 4U);
  EXPECT_EQ(losses.records(), 3U);
  EXPECT_FALSE(losses.take(event(EventKind::point, 6)));
}

TEST(StreamLosses, TheFirstRecordsOfADeviceAreMissedToo) {
  StreamLosses losses;
  const auto lost = losses.take(event(EventKind::point, 8));
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->first, 1U);
  EXPECT_EQ(lost->last, 7U);
}

TEST(StreamLosses, TheEndTellsOfRecordsThatNeverCame) {
  StreamLosses losses;
  EXPECT_FALSE(losses.take(event(EventKind::point, 1)));
  EXPECT_FALSE(losses.finished());
  const auto lost = losses.take(event(EventKind::finished, 2000));
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->first, 2U);
  EXPECT_EQ(lost->last, 2000U);
  EXPECT_TRUE(losses.finished());
  EXPECT_FALSE(losses.take(event(EventKind::point, 2001)));
  EXPECT_FALSE(losses.finished()) << "probing goes on";
}

TEST(StreamLosses, AnEndWithoutANumberTellsNothing) {
  StreamLosses losses;
  EXPECT_FALSE(losses.take(event(EventKind::point, 1)));
  EXPECT_FALSE(losses.take(event(EventKind::finished, 0)));
  EXPECT_TRUE(losses.finished());
  EXPECT_FALSE(losses.any());
}

TEST(StreamLosses, PointsWithoutANumberCountAsLost) {
  StreamLosses losses;
  EXPECT_FALSE(losses.take(event(EventKind::lost_unnumbered)));
  EXPECT_TRUE(losses.any());
  EXPECT_EQ(losses.records(), 0U);
}

TEST(StreamLosses, RecordsThatAreGivenUpAreLostAtOnce) {
  StreamLosses losses;
  EXPECT_FALSE(losses.take(event(EventKind::point, 1)));
  const auto lost = losses.take(event(EventKind::lost, 9));
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->first, 2U);
  EXPECT_EQ(lost->last, 9U);
  EXPECT_FALSE(losses.take(event(EventKind::point, 10)));
  EXPECT_EQ(losses.records(), 8U);
}

TEST(StreamLosses, NothingIsLostBehindTheLastNumberThereIs) {
  constexpr std::uint32_t kLast = 0xFFFFFFFFU;
  StreamLosses losses;
  EXPECT_TRUE(losses.take(event(EventKind::point, kLast - 1)));
  EXPECT_FALSE(losses.take(event(EventKind::point, kLast)));
  EXPECT_FALSE(losses.take(event(EventKind::finished, kLast)));
  EXPECT_EQ(losses.records(), kLast - 2);
}

TEST(StreamLosses, AResetForgetsThemAndGoesOnWithTheNumbering) {
  StreamLosses losses;
  EXPECT_TRUE(losses.take(event(EventKind::point, 3)));
  EXPECT_FALSE(losses.take(event(EventKind::lost_unnumbered)));
  EXPECT_FALSE(losses.take(event(EventKind::reset)));
  EXPECT_FALSE(losses.any());
  EXPECT_FALSE(losses.take(event(EventKind::point, 4)));
  EXPECT_TRUE(losses.take(event(EventKind::point, 6)));
}

}  // namespace
}  // namespace bladefit
