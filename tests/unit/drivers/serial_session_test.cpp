#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "drivers/serial/serial_message.hpp"
#include "drivers/serial/serial_session.hpp"
#include "tests/unit/drivers/collecting.hpp"
#include "tests/unit/drivers/serial_body.hpp"

namespace bladefit {
namespace {

using std::chrono::milliseconds;

/// A session at a time that the test sets.
struct SerialBench {
  SerialSettings settings;
  SourceStatus status;
  SerialSession session{settings, status};
  SerialSession::Clock::time_point now = SerialSession::Clock::time_point{} + std::chrono::hours(1);

  explicit SerialBench(std::uint32_t after = 0, std::uint32_t run_id = 3) {
    session.restart(after, run_id);
    session.link_made(now);
  }

  void hear(std::string_view content) { session.received(parse_message(body(content)), now, 1); }

  void point(std::uint32_t sequence) { hear("PT," + std::to_string(sequence) + ",1,2,3,0,0,0,0"); }

  void wait(int ms) {
    now += milliseconds(ms);
    session.tick(now);
  }

  /// What was sent since the last time, without check sums: "START,1 ACK,3".
  std::string sent() {
    std::string text = session.take_output(), words;
    for (std::size_t begin = text.find('$'); begin != std::string::npos; begin = text.find('$', begin + 1)) {
      words += (words.empty() ? "" : " ") + text.substr(begin + 1, text.find('*', begin) - begin - 1);
    }
    return words;
  }

  Sequences take() { return take_sequences(session.points()); }
};

TEST(SerialSession, RepeatsAnUnansweredStart) {
  SerialBench bench(4);
  EXPECT_EQ(bench.sent(), "START,5");
  bench.wait(499);
  EXPECT_EQ(bench.sent(), "");
  bench.wait(1);
  EXPECT_EQ(bench.sent(), "START,5");
  bench.point(5);
  EXPECT_EQ(bench.take(), Sequences{}) << "ahead of $RUN it may be of another run";
  bench.hear("RUN,3");
  EXPECT_TRUE(bench.session.running());
  EXPECT_EQ(bench.status.run_id, 3U);
  EXPECT_EQ(bench.status.link, LinkState::up);
}

TEST(SerialSession, StopsWhereTheProgramEndsBeforeWhatWasTaken) {
  SerialBench bench;
  bench.hear("RUN,1");
  for (const std::uint32_t sequence : {1U, 2U, 3U}) bench.point(sequence);
  bench.hear("END,2");
  bench.point(4);
  bench.hear("END,2");
  EXPECT_FALSE(bench.session.stopped()) << "one may be an older line";
  bench.hear("END,2");
  EXPECT_TRUE(bench.session.stopped());
  EXPECT_NE(bench.status.stopped.find("ends with record 2 although record 4 was read"), std::string::npos)
      << bench.status.stopped;
}

TEST(SerialSession, AsksForNoRecordBehindTheLastNumberThereIs) {
  constexpr std::uint32_t kLast = 0xFFFFFFFFU;
  SerialBench bench(kLast - 1);
  bench.hear("RUN,3");
  static_cast<void>(bench.sent());
  bench.point(kLast);
  EXPECT_EQ(bench.take(), Sequences{kLast});
  bench.session.acknowledge(kLast);
  EXPECT_EQ(bench.sent(), "ACK,4294967295");
  bench.wait(1500);
  EXPECT_EQ(bench.sent(), "ACK,4294967295") << "no record 0 is missing";
  EXPECT_EQ(bench.session.last(), kLast);
  for (int silence = 0; silence < 12; ++silence) bench.wait(1500);
  EXPECT_EQ(bench.status.losses, 0U);
  EXPECT_TRUE(bench.status.stopped.empty()) << bench.status.stopped;
}

TEST(SerialSession, DeliversOnceInOrderAndAcknowledges) {
  SerialBench bench;
  bench.hear("RUN,1");
  static_cast<void>(bench.sent());
  for (const std::uint32_t sequence : {1U, 2U, 2U, 1U, 3U}) bench.point(sequence);
  EXPECT_EQ(bench.take(), (Sequences{1, 2, 3}));
  EXPECT_EQ(bench.status.duplicates, 2U);
  bench.session.acknowledge(2);
  bench.session.acknowledge(3);
  EXPECT_EQ(bench.sent(), "ACK,3");
  EXPECT_EQ(bench.sent(), "");
  bench.hear("END,3");
  EXPECT_TRUE(bench.session.finished());
  bench.point(4);
  EXPECT_FALSE(bench.session.finished());
}

TEST(SerialSession, AsksForAMissingRecordAtMostOnceAnInterval) {
  SerialBench bench;
  bench.hear("RUN,1");
  static_cast<void>(bench.sent());
  bench.point(1);
  bench.point(3);
  EXPECT_EQ(bench.sent(), "NAK,2");
  bench.point(4);
  bench.wait(249);
  EXPECT_EQ(bench.sent(), "");
  bench.wait(1);
  EXPECT_EQ(bench.sent(), "NAK,2") << "by the clock, should nothing more come";
  bench.point(2);
  EXPECT_EQ(bench.take(), (Sequences{1, 2, 3, 4})) << "those behind the gap were kept";
  EXPECT_EQ(bench.status.resends, 2U);
  EXPECT_EQ(bench.status.losses, 0U);
}

TEST(SerialSession, AsksAgainAfterDamageUnlessTheNextRecordFollows) {
  SerialBench bench;
  bench.hear("RUN,1");
  static_cast<void>(bench.sent());
  bench.session.damaged("noise", bench.now);
  EXPECT_EQ(bench.status.damaged, 1U);
  bench.point(1);
  bench.wait(100);
  EXPECT_EQ(bench.sent(), "");
  bench.session.damaged("noise", bench.now);
  bench.wait(50);
  EXPECT_EQ(bench.sent(), "NAK,2");
}

TEST(SerialSession, NoticesAnEndThatComesTooEarly) {
  SerialBench bench;
  bench.hear("RUN,1");
  static_cast<void>(bench.sent());
  bench.hear("END,2");
  EXPECT_FALSE(bench.session.finished());
  EXPECT_EQ(bench.sent(), "NAK,1");
  bench.point(1);
  bench.point(2);
  EXPECT_FALSE(bench.session.finished()) << "not handed out yet";
  EXPECT_EQ(bench.take(), (Sequences{1, 2}));
  EXPECT_TRUE(bench.session.finished());
}

TEST(SerialSession, BreaksTheSilence) {
  SerialBench bench;
  bench.hear("RUN,1");
  bench.point(1);
  bench.session.acknowledge(1);
  static_cast<void>(bench.sent());
  bench.wait(1000);
  EXPECT_EQ(bench.sent(), "ACK,1 NAK,2");
  for (int silence = 2; silence <= 4; ++silence) bench.wait(1000);
  static_cast<void>(bench.sent());
  bench.wait(1000);
  EXPECT_EQ(bench.sent(), "ACK,1 START,2") << "does it still live?";
  EXPECT_EQ(bench.status.link, LinkState::up);
  for (int start = 0; start < 3; ++start) bench.wait(500);
  EXPECT_EQ(bench.status.link, LinkState::lost);
  bench.hear("RUN,1");
  EXPECT_EQ(bench.status.link, LinkState::up);
  bench.point(2);
  EXPECT_EQ(bench.take(), (Sequences{1, 2}));
}

TEST(SerialSession, StartsAgainFromWhatIsStoredNotFromWhatCame) {
  SerialBench bench;
  bench.hear("RUN,1");
  for (const std::uint32_t sequence : {1U, 2U, 3U}) bench.point(sequence);
  bench.session.acknowledge(2);
  static_cast<void>(bench.sent());
  bench.session.link_lost();
  bench.session.link_made(bench.now);
  EXPECT_EQ(bench.sent(), "START,3");
  bench.hear("RUN,1");
  bench.point(3);
  bench.point(4);
  EXPECT_EQ(bench.take(), (Sequences{1, 2, 3, 4}));
}

TEST(SerialSession, StopsWhenTheNumberingHasRestarted) {
  SerialBench bench;
  bench.hear("RUN,1");
  bench.point(1);
  bench.hear("RUN,2");
  EXPECT_TRUE(bench.session.stopped());
  EXPECT_EQ(bench.status.run_id, 2U);
  EXPECT_NE(bench.status.last_fault.find("another run (2 instead of 1)"), std::string::npos);
  bench.point(2);
  EXPECT_EQ(bench.take(), (Sequences{1}));
  EXPECT_FALSE(bench.session.finished());
}

TEST(SerialSession, TakesRunZeroForARunLikeAnyOther) {
  for (const auto& [before, now] : {std::pair{0U, 7U}, {4U, 0U}}) {
    SerialBench going;
    going.hear("RUN," + std::to_string(before));
    going.point(1);
    going.hear("RUN," + std::to_string(now));
    EXPECT_TRUE(going.session.stopped());
    SerialBench resumed(30, before);
    resumed.hear("RUN," + std::to_string(now));
    EXPECT_TRUE(resumed.session.stopped());
    EXPECT_EQ(resumed.status.run_id, now);
    EXPECT_EQ(resumed.sent(), "START,31");
  }
}

TEST(SerialSession, FinishesWithoutPointsWhenToldSo) {
  SerialBench bench;
  bench.hear("RUN,1");
  static_cast<void>(bench.sent());
  EXPECT_FALSE(bench.session.finished());
  bench.hear("END,0");
  EXPECT_TRUE(bench.session.finished());
  EXPECT_FALSE(bench.session.behind());
  bench.wait(1000);
  EXPECT_EQ(bench.sent(), "") << "there is nothing to be asked for";
  bench.point(1);
  EXPECT_FALSE(bench.session.finished()) << "probing goes on";
}

TEST(SerialSession, GivesUpARecordThatTheDeviceDoesNotSend) {
  SerialBench bench;
  bench.settings.resend_tries = 2;
  bench.hear("RUN,1");
  bench.point(3);
  bench.wait(250);
  EXPECT_EQ(bench.status.losses, 0U);
  EXPECT_TRUE(bench.session.behind());
  bench.wait(250);
  EXPECT_GT(bench.status.losses, 0U);
  EXPECT_FALSE(bench.session.behind());
  EXPECT_NE(bench.status.last_fault.find("points 1..2 are lost"), std::string::npos) << bench.status.last_fault;
  EXPECT_EQ(bench.take(), (Sequences{3}));
}

TEST(SerialSession, TellsAnEchoThatNobodyExpected) {
  SerialBench bench;
  bench.hear("START,1");
  EXPECT_NE(bench.status.last_fault.find("set echo = true"), std::string::npos);
}

}  // namespace
}  // namespace bladefit
