#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "drivers/serial/echo_filter.hpp"
#include "drivers/serial/line_framer.hpp"
#include "drivers/serial/serial_message.hpp"
#include "tests/unit/drivers/serial_body.hpp"

namespace bladefit {
namespace {

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

class LineFramerStreams : public ::testing::TestWithParam<Stream> {};

TEST_P(LineFramerStreams, AreCutAlikeHoweverTheyCome) {
  for (const std::size_t piece : {1U, 2U, 3U, 1000U})
    EXPECT_EQ(framed(GetParam().bytes, piece), GetParam().lines) << piece;
}

INSTANTIATE_TEST_SUITE_P(All, LineFramerStreams,
                         ::testing::Values(Stream{"$A*1\r\n$B*2\r\n", {"A*1", "B*2"}}, Stream{"$A\n", {"A"}},
                                           Stream{"\r\n\r\n$A\r\n", {"A"}}, Stream{"xyz$A\r\n", {"!", "A"}},
                                           Stream{"x\r\n$A\r\n", {"!", "A"}}, Stream{"$A$B\r\n", {"!", "B"}},
                                           Stream{"$A\r\nB\r\n$C\r\n", {"A", "!", "C"}},
                                           Stream{"$" + std::string(300, 'x') + "\r\n$A\r\n", {"!", "!", "A"}},
                                           Stream{std::string("$\0\xff\r\n", 5), {std::string("\0\xff", 2)}},
                                           Stream{"$half", {}}));

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

class DamagedMessages : public ::testing::TestWithParam<std::string> {};

TEST_P(DamagedMessages, AreRefused) {
  const SerialMessage message = parse_message(GetParam());
  EXPECT_EQ(message.kind, SerialMessage::Kind::damaged);
  EXPECT_NE(message.damage, "");
}

INSTANTIATE_TEST_SUITE_P(All, DamagedMessages,
                         ::testing::Values("", "*", "RUN,1", "RUN,1*0000", "RUN,1*" + body("RUN,1").substr(6) + "0",
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

}  // namespace
}  // namespace bladefit
