// Records that arrive out of their order, and when they are asked for again.
#include "drivers/serial/record_order.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "drivers/serial/resend_request.hpp"

namespace bladefit {
namespace {

using std::chrono::milliseconds;
using Place = RecordOrder::Place;

ProbePoint record(std::uint32_t sequence) {
  ProbePoint point;
  point.sequence = sequence;
  return point;
}

std::vector<std::uint32_t> taken(RecordOrder& order) {
  std::array<ProbePoint, 16> points;
  std::vector<std::uint32_t> sequences;
  const std::size_t count = order.points().take(points);
  for (std::size_t index = 0; index < count; ++index) sequences.push_back(points[index].sequence);
  return sequences;
}

TEST(RecordOrder, KeepsWhatComesAheadUntilTheMissingRecordIsThere) {
  RecordOrder order;
  EXPECT_EQ(order.take(record(1)), Place::delivered);
  EXPECT_EQ(order.take(record(3)), Place::ahead);
  EXPECT_EQ(order.take(record(3)), Place::ahead_again);
  EXPECT_EQ(order.take(record(4)), Place::ahead);
  EXPECT_TRUE(order.behind());
  EXPECT_EQ(order.take(record(2)), Place::delivered);
  EXPECT_EQ(order.take(record(2)), Place::old);
  EXPECT_FALSE(order.behind());
  EXPECT_EQ(taken(order), (std::vector<std::uint32_t>{1, 2, 3, 4}));
}

TEST(RecordOrder, GivesUpOnlyWhatIsMissing) {
  RecordOrder order;
  order.restart(10);
  EXPECT_EQ(order.take(record(14)), Place::ahead);
  const RecordOrder::Gap gap = order.skip_missing();
  EXPECT_EQ(gap.first, 11U);
  EXPECT_EQ(gap.last, 13U);
  EXPECT_TRUE(gap.delivered);
  EXPECT_EQ(taken(order), (std::vector<std::uint32_t>{14}));
  ASSERT_TRUE(order.end_at(16));
  EXPECT_TRUE(order.behind());
  const RecordOrder::Gap end = order.skip_missing();
  EXPECT_EQ(end.first, 15U);
  EXPECT_EQ(end.last, 16U);
  EXPECT_FALSE(end.delivered);
  EXPECT_TRUE(order.complete());
}

TEST(RecordOrder, AnEndIsNoEndWhenMoreComes) {
  RecordOrder order;
  ASSERT_TRUE(order.end_at(0));
  EXPECT_TRUE(order.complete());
  EXPECT_EQ(order.take(record(1)), Place::delivered);
  EXPECT_FALSE(order.complete());
  EXPECT_FALSE(order.behind());
  EXPECT_FALSE(order.end_at(0)) << "older than what is here";
}

TEST(RecordOrder, EndsWithTheLastNumberThereIs) {
  constexpr std::uint32_t kLast = 0xFFFFFFFFU;
  RecordOrder order;
  order.restart(kLast - 2);
  EXPECT_EQ(order.take(record(kLast)), Place::ahead);
  EXPECT_EQ(order.take(record(kLast - 1)), Place::delivered);
  EXPECT_EQ(taken(order), (std::vector<std::uint32_t>{kLast - 1, kLast}));
  EXPECT_FALSE(order.behind());
  ASSERT_TRUE(order.end_at(kLast));
  EXPECT_TRUE(order.complete());
  EXPECT_EQ(order.take(record(1)), Place::old);
}

TEST(ResendRequest, AsksForTheSameRecordLessOftenThanForAnother) {
  SerialSettings settings;
  settings.resend_tries = 2;
  ResendRequest resend(settings);
  const ResendRequest::Clock::time_point now = ResendRequest::Clock::time_point{} + std::chrono::hours(1);
  resend.doubt(now);
  EXPECT_EQ(resend.due_after_doubt(5), now + settings.resend_pause);
  resend.ask(5, now);
  EXPECT_FALSE(resend.doubtful());
  EXPECT_EQ(resend.due(5), now + settings.resend_interval);
  EXPECT_EQ(resend.due(6), now + settings.resend_pause);
  EXPECT_FALSE(resend.in_vain(5, now + settings.resend_interval));
  resend.ask(5, now);
  EXPECT_EQ(resend.times(), 2);
  EXPECT_FALSE(resend.in_vain(5, now)) << "the answer may still come";
  EXPECT_TRUE(resend.in_vain(5, now + settings.resend_interval));
  EXPECT_FALSE(resend.in_vain(6, now + settings.resend_interval));
}

}  // namespace
}  // namespace bladefit
