// What is asked of a CMM next, and what its headers in a row prove.
#include "drivers/modbus/request_schedule.hpp"

#include <gtest/gtest.h>

#include "drivers/modbus/header_watch.hpp"
#include "drivers/modbus/link_health.hpp"

namespace bladefit {
namespace {

using std::chrono::milliseconds;

const RequestSchedule::Clock::time_point kNow = RequestSchedule::Clock::time_point{} + std::chrono::hours(1);
constexpr milliseconds kPeriod{20};

TEST(RequestSchedule, HeaderAndRecordsTakeTurnsWhereTheHeaderIsAlwaysDue) {
  RequestSchedule schedule(kPeriod);
  schedule.restart(kNow);
  EXPECT_TRUE(schedule.take_header_turn(kNow, true));
  EXPECT_FALSE(schedule.take_header_turn(kNow, true));
  EXPECT_TRUE(schedule.take_header_turn(kNow, true));
  EXPECT_TRUE(schedule.take_header_turn(kNow, false)) << "no records are waiting";
  schedule.delay_header(kNow);
  EXPECT_FALSE(schedule.take_header_turn(kNow, false));
  EXPECT_EQ(schedule.next_turn(), kNow + kPeriod);
  schedule.hasten_header(kNow);
  EXPECT_TRUE(schedule.take_header_turn(kNow, false));
}

TEST(RequestSchedule, ARefusedWriteWaitsForTimeAndForARead) {
  RequestSchedule schedule(kPeriod);
  schedule.restart(kNow);
  schedule.write_refused(kNow);
  EXPECT_FALSE(schedule.may_write(kNow));
  EXPECT_FALSE(schedule.may_write(kNow + kPeriod));
  EXPECT_TRUE(schedule.may_read(kNow));
  schedule.reading();
  EXPECT_FALSE(schedule.may_write(kNow));
  EXPECT_TRUE(schedule.may_write(kNow + kPeriod));
}

TEST(RequestSchedule, ARefusedReadDoesNotKeepFromWriting) {
  RequestSchedule schedule(kPeriod);
  schedule.restart(kNow);
  schedule.read_refused(kNow);
  EXPECT_TRUE(schedule.may_write(kNow));
  EXPECT_FALSE(schedule.may_read(kNow));
  EXPECT_FALSE(schedule.take_header_turn(kNow, false));
  EXPECT_EQ(schedule.next_turn(), kNow + kPeriod);
}

TEST(HeaderWatch, BelievesInAnotherRunWhenTwoHeadersSaySo) {
  HeaderWatch headers;
  headers.restart(7);
  headers.accept(8, true, true);
  EXPECT_TRUE(headers.foreign());
  EXPECT_FALSE(headers.surely_foreign());
  headers.accept(7, true, true);
  EXPECT_FALSE(headers.foreign());
  headers.accept(8, true, true);
  headers.accept(8, true, true);
  EXPECT_TRUE(headers.surely_foreign());
  headers.restart(7);
  headers.accept(8, false, true);
  EXPECT_FALSE(headers.foreign()) << "no record was taken that could be of another run";
}

TEST(HeaderWatch, OpensAfterThreeHeadersThatCount) {
  HeaderWatch headers;
  headers.accept(1, false, true);
  headers.accept(1, false, false);
  headers.accept(1, false, true);
  EXPECT_FALSE(headers.enough_to_open());
  headers.accept(1, false, true);
  EXPECT_TRUE(headers.enough_to_open());
  EXPECT_FALSE(headers.refuse());
  EXPECT_FALSE(headers.refuse());
  headers.accept(1, false, true);
  EXPECT_FALSE(headers.refuse()) << "a good one came between";
}

TEST(LinkHealth, CountsAReconnectAndMissingReplies) {
  LinkHealth health(milliseconds(10), milliseconds(40));
  EXPECT_FALSE(health.make());
  for (int reply = 0; reply < LinkHealth::kTimeoutsToLost; ++reply) health.reply_missing();
  EXPECT_TRUE(health.seems_lost());
  health.fail(kNow);
  EXPECT_EQ(health.retry_at(), kNow + milliseconds(10));
  EXPECT_TRUE(health.make());
  EXPECT_FALSE(health.seems_lost());
  health.restart();
  EXPECT_FALSE(health.ever_made());
}

}  // namespace
}  // namespace bladefit
