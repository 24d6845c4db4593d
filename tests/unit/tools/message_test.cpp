#include "tools/files/message.hpp"

#include <gtest/gtest.h>

#include <string>

namespace bladefit {
namespace {

TEST(Message, OfUsualLengthStaysAsItIs) {
  EXPECT_EQ(one_line("a.csv:3: no number; write one"), "a.csv:3: no number; write one");
}

TEST(Message, IsOneLine) { EXPECT_EQ(one_line("a\nb\tc\x1b"), "a b c "); }

TEST(Message, KeepsBeginningAndWayOutOfLongNames) {
  const std::string told = one_line(std::string(4000, 'd') + "/points.csv: no such file; check the name");
  EXPECT_LE(told.size(), 280U);
  EXPECT_TRUE(told.starts_with("ddd"));
  EXPECT_TRUE(told.ends_with("ddd/points.csv: no such file; check the name"));
}

TEST(Message, OfManyWordsLosesItsMiddle) {
  std::string words = "first";
  for (int k = 0; k < 200; ++k) words += " word";
  const std::string told = one_line(words + " last");
  EXPECT_LE(told.size(), 280U);
  EXPECT_TRUE(told.starts_with("first word"));
  EXPECT_NE(told.find("..."), std::string::npos);
  EXPECT_TRUE(told.ends_with("word last"));
}

TEST(Message, CutsNoCharacterInTwo) {
  std::string umlauts;
  for (int k = 0; k < 400; ++k) umlauts += "\xC3\xBC";
  const std::string told = one_line(umlauts);
  const std::size_t cut = told.find("...");
  EXPECT_EQ(cut % 2, 0U);
  EXPECT_EQ((told.size() - cut - 3) % 2, 0U);
}

}  // namespace
}  // namespace bladefit
