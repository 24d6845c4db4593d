#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "drivers/dro/dro_line.hpp"
#include "drivers/serial/echo_filter.hpp"
#include "drivers/serial/line_framer.hpp"
#include "drivers/serial/serial_message.hpp"
#include "drivers/serial/serial_session.hpp"

namespace bladefit {
namespace {

using std::chrono::milliseconds;

/// What the framer makes of bytes that come in pieces of `piece`: texts, and "!" for damage.
std::vector<std::string> framed(std::string_view bytes, std::size_t piece) {
  LineFramer framer;
  std::vector<std::string> lines;
  while (!bytes.empty()) {
    framer.add(bytes.substr(0, piece));
    bytes.remove_prefix(std::min(piece, bytes.size()));
    while (const std::optional<FramedLine> line = framer.next())
      lines.push_back(line->damage.empty() ? line->text : "!");
  }
  return lines;
}

struct Stream {
  std::string bytes;
  std::vector<std::string> lines;
};

class LineFramerStreams : public testing::TestWithParam<Stream> {};

TEST_P(LineFramerStreams, AreCutAlikeHoweverTheyCome) {
  for (const std::size_t piece : {1U, 2U, 3U, 1000U})
    EXPECT_EQ(framed(GetParam().bytes, piece), GetParam().lines) << piece;
}

INSTANTIATE_TEST_SUITE_P(All, LineFramerStreams,
                         testing::Values(Stream{"$A*1\r\n$B*2\r\n", {"A*1", "B*2"}}, Stream{"$A\n", {"A"}},
                                         Stream{"\r\n\r\n$A\r\n", {"A"}}, Stream{"xyz$A\r\n", {"!", "A"}},
                                         Stream{"x\r\n$A\r\n", {"!", "A"}}, Stream{"$A$B\r\n", {"!", "B"}},
                                         Stream{"$A\r\nB\r\n$C\r\n", {"A", "!", "C"}},
                                         Stream{"$" + std::string(300, 'x') + "\r\n$A\r\n", {"!", "!", "A"}},
                                         Stream{std::string("$\0\xff\r\n", 5), {std::string("\0\xff", 2)}},
                                         Stream{"$half", {}}));

std::string body(std::string_view content) {
  const std::string line = encode_line(content);
  return line.substr(1, line.size() - 3);
}

TEST(SerialMessages, AreDecoded) {
  EXPECT_EQ(encode_line("STOP"), "$STOP*BC64\r\n");
  const SerialMessage point = parse_message(body("PT,7,1.5,-2,+3e-1,0,0,-1,4"));
  EXPECT_EQ(point.kind, SerialMessage::Kind::point);
  EXPECT_EQ(point.number, 7U);
  EXPECT_EQ(point.point.position, (std::array<double, 3>{1.5, -2, 0.3}));
  EXPECT_EQ(point.point.approach, (std::array<double, 3>{0, 0, -1}));
  EXPECT_EQ(point.point.path, 4);
  EXPECT_EQ(parse_message(body("RUN,12")).number, 12U);
  EXPECT_EQ(parse_message(body("END,0")).kind, SerialMessage::Kind::finished);
  EXPECT_EQ(parse_message(body("ACK,3")).kind, SerialMessage::Kind::host);
}

class DamagedMessages : public testing::TestWithParam<std::string> {};

TEST_P(DamagedMessages, AreRefused) {
  const SerialMessage message = parse_message(GetParam());
  EXPECT_EQ(message.kind, SerialMessage::Kind::damaged);
  EXPECT_NE(message.damage, "");
}

INSTANTIATE_TEST_SUITE_P(All, DamagedMessages,
                         testing::Values("", "*", "RUN,1", "RUN,1*0000", "RUN,1*" + body("RUN,1").substr(6) + "0",
                                         body("RUN,-1"), body("RUN"), body("FOO,1"), body("PT,1,2,3"),
                                         body("PT,1,2,3,4,0,0,0,0,9"), body("PT,0,2,3,4,0,0,0,0"),
                                         body("PT,1,nan,3,4,0,0,0,0"), body("PT,1,inf,3,4,0,0,0,0"),
                                         body("PT,1,2,3,4,1,1,1,0"), body("PT,1,2,3,4,0,0,0,70000"),
                                         body("PT,4294967296,2,3,4,0,0,0,0"), body("PT,1,2,,4,0,0,0,0")));

TEST(SerialMessages, RefuseEveryChangedCharacter) {
  const std::string line = body("PT,7,1.5,-2,3,0,0,-1,4");
  for (std::size_t place = 0; place < line.size(); ++place) {
    std::string changed = line;
    changed[place] = static_cast<char>(changed[place] ^ 1);
    EXPECT_EQ(parse_message(changed).kind, SerialMessage::Kind::damaged) << changed;
  }
}

TEST(EchoFilter, TakesItsOwnLinesOnce) {
  EchoFilter echo;
  echo.sent("$A*1\r\n$B*2\r\n");
  EXPECT_FALSE(echo.takes("C*3"));
  EXPECT_TRUE(echo.takes("B*2"));
  EXPECT_FALSE(echo.takes("A*1")) << "given up when the later one came";
  for (std::size_t line = 0; line <= EchoFilter::kMostExpected; ++line) echo.sent("$A*1\r\n");
  EXPECT_TRUE(echo.overdue());
}

/// A session at a time that the test sets.
struct Bench {
  SerialSettings settings;
  SourceStatus status;
  SerialSession session{settings, status};
  SerialSession::Clock::time_point now = SerialSession::Clock::time_point{} + std::chrono::hours(1);

  explicit Bench(std::uint32_t after = 0) {
    session.restart(after);
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

  std::vector<std::uint32_t> take() {
    std::array<ProbePoint, 64> points;
    const std::size_t count = session.points().take(points);
    std::vector<std::uint32_t> sequences;
    for (std::size_t index = 0; index < count; ++index) sequences.push_back(points[index].sequence);
    return sequences;
  }
};

using Sequences = std::vector<std::uint32_t>;

TEST(SerialSession, RepeatsAnUnansweredStart) {
  Bench bench(4);
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

TEST(SerialSession, DeliversOnceInOrderAndAcknowledges) {
  Bench bench;
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
  Bench bench;
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
  EXPECT_FALSE(bench.status.gap);
}

TEST(SerialSession, AsksAgainAfterDamageUnlessTheNextRecordFollows) {
  Bench bench;
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
  Bench bench;
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
  Bench bench;
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
  Bench bench;
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
  Bench bench;
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

TEST(SerialSession, GivesUpARecordThatTheDeviceDoesNotSend) {
  Bench bench;
  bench.settings.resend_tries = 2;
  bench.hear("RUN,1");
  bench.point(3);
  bench.wait(250);
  EXPECT_FALSE(bench.status.gap);
  bench.wait(250);
  EXPECT_TRUE(bench.status.gap);
  EXPECT_NE(bench.status.last_fault.find("records 1..2 are lost"), std::string::npos) << bench.status.last_fault;
  EXPECT_EQ(bench.take(), (Sequences{3}));
}

TEST(SerialSession, TellsAnEchoThatNobodyExpected) {
  Bench bench;
  bench.hear("START,1");
  EXPECT_NE(bench.status.last_fault.find("set echo = true"), std::string::npos);
}

struct DroCase {
  const char* line;
  const char* error;  ///< part of the message; empty = the line is good
};

class DroLines : public testing::TestWithParam<DroCase> {};

TEST_P(DroLines, AreReadOrRefused) {
  std::array<double, 3> position{};
  const std::string error = parse_dro_line(GetParam().line, DroSettings{}, position);
  if (std::string_view(GetParam().error).empty()) {
    EXPECT_EQ(error, "");
    EXPECT_EQ(position, (std::array<double, 3>{123.4567, -1.2, 0}));
  } else {
    EXPECT_NE(error.find(GetParam().error), std::string::npos) << error;
    EXPECT_EQ(position, (std::array<double, 3>{}));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, DroLines,
    testing::Values(DroCase{"X +0123.4567 Y -0001.2000 Z 0000.0000", ""}, DroCase{"x=123.4567; y=-1.2; z=0", ""},
                    DroCase{"  X+123.4567Y-1.2Z0  ", ""}, DroCase{"X 1 Y 2", "the label Z is missing"},
                    DroCase{"X 1 Y 2 Z", "no number stands for Z"}, DroCase{"Y 1 X 2 Z 3", "the label X is missing"},
                    DroCase{"X 1 Y 2 Z 3 4", "more than three"}, DroCase{"X 1 Y nan Z 3", "no number stands for Y"},
                    DroCase{"X 1,5 Y 2 Z 3", "the label Y is missing"}, DroCase{"", "the label X is missing"},
                    DroCase{"X 1e999 Y 2 Z 3", "no number stands for X"}));

TEST(DroLine, FollowsItsSettings) {
  DroSettings settings;
  settings.labels = false;
  settings.order = "zxy";
  settings.decimal_mark = ',';
  settings.separators = " ;";
  settings.mm_per_unit = 25.4;
  std::array<double, 3> position{};
  ASSERT_EQ(parse_dro_line("1,5; 2 ;-3", settings, position), "");
  EXPECT_EQ(position, (std::array<double, 3>{2 * 25.4, -3 * 25.4, 1.5 * 25.4}));
  EXPECT_NE(parse_dro_line("1.5; 2 ;-3", settings, position), "");
}

}  // namespace
}  // namespace bladefit
