// Read-out lines: what is read, and what is refused in which words.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>

#include "drivers/dro/dro_line.hpp"

namespace bladefit {
namespace {

using Position = std::array<double, 3>;

Position position_of(const DroLine& line) {
  Position position{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (line.axes[axis]) position[axis] = line.axes[axis]->mm;
  }
  return position;
}

struct DroCase {
  const char* line;
  const char* error;  ///< part of the message; empty = the line is good
};

class DroLines : public ::testing::TestWithParam<DroCase> {};

TEST_P(DroLines, AreReadOrRefused) {
  DroLine line;
  const std::string error = parse_dro_line(GetParam().line, DroSettings{}, line).message;
  if (std::string_view(GetParam().error).empty()) {
    EXPECT_EQ(error, "");
    EXPECT_EQ(position_of(line), (Position{123.4567, -1.2, 0}));
  } else {
    EXPECT_NE(error.find(GetParam().error), std::string::npos) << error;
    EXPECT_EQ(line.count(), 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, DroLines,
    ::testing::Values(DroCase{"X +0123.4567 Y -0001.2000 Z 0000.0000", ""}, DroCase{"x=123.4567; y=-1.2; z=0", ""},
                      DroCase{"  X+123.4567Y-1.2Z0  ", ""}, DroCase{"X + 123.4567 Y -   1.2000 Z   0.0000", ""},
                      DroCase{"X=+ 123.4567 R Y=-   1.2000 R Z=    .0000 A", ""},
                      DroCase{"Z 0.0 X 123.4567mm Y -\t1.2 MM", ""}, DroCase{"X 1 Y 2", "the label Z is missing"},
                      DroCase{"X 1 Y 2 Z", "no number stands for Z"}, DroCase{"X 1 2 Y 3", "the label Y is missing"},
                      DroCase{"X 1 Y 2 Z 3 4", "more than three"}, DroCase{"X 1 Y 2 X 3", "X stands in the line twice"},
                      DroCase{"X 1 Y nan Z 3", "no number stands for Y"},
                      DroCase{"X - - 1 Y 2 Z 3", "no number stands for X"},
                      DroCase{"X - ; 1 Y 2 Z 3", "no number stands for X"},
                      DroCase{"X 1,5 Y 2 Z 3", "a ',' stands within the number for X (set decimal_mark"},
                      DroCase{"X 1.5\" Y 2.5\" Z 3.5\"", "X is marked \", but units are mm (set units"},
                      DroCase{"X 1.5 Y 2.5 in Z 3.5", "Y is marked in, but units are mm"},
                      DroCase{"X 1.5 D Y 2.5 R Z 3.5 R", "X is marked D, a diameter"},
                      DroCase{"X 1.5 Y 2.5 ? Z 3.5", "the mark '?' behind Y is unknown (name it in marks"},
                      DroCase{"X 1e999 Y 2 Z 3", "the mark 'e' behind X is unknown"},
                      DroCase{"12.5 Y 2 Z 3", "the label X is missing"}));

TEST(DroLine, FollowsItsSettings) {
  DroSettings settings;
  settings.labels = false;
  settings.order = "zxy";
  settings.decimal_mark = ',';
  settings.separators = " ;";
  settings.mm_per_unit = 25.4;
  DroLine line;
  ASSERT_EQ(parse_dro_line("1,5\"; 2 ;-  3 IN", settings, line).message, "");
  EXPECT_EQ(position_of(line), (Position{2 * 25.4, -3 * 25.4, 1.5 * 25.4}));
  EXPECT_NE(parse_dro_line("1.5; 2 ;-3", settings, line).message.find("a '.' stands within the number for Z"),
            std::string::npos);
  EXPECT_NE(parse_dro_line("1,5; 2 mm;-3", settings, line).message.find("X is marked mm, but units are in"),
            std::string::npos);
}

TEST(DroLine, CountsAreScaled) {
  DroSettings settings;
  settings.scale = 0.001;
  DroLine line;
  ASSERT_EQ(parse_dro_line("X +0123456 Y -0001200 Z 0000000", settings, line).message, "");
  EXPECT_EQ(position_of(line), (Position{123.456, -1.2, 0}));
  EXPECT_NE(parse_dro_line("X 123.456 Y 1 Z 2", settings, line).message.find("X has a decimal mark (leave scale out)"),
            std::string::npos);
}

TEST(DroLine, HoldsOneAxisOrThreeAsTheSettingsSay) {
  DroSettings settings;
  DroLine line;
  ASSERT_EQ(parse_dro_line("Y=-   1.2000 R", settings, line).message, "");
  EXPECT_EQ(line.count(), 1U);
  EXPECT_EQ(line.first_axis(), 1U);
  EXPECT_EQ(line.axes[1]->mm, -1.2);
  EXPECT_EQ(line.axes[1]->marks, "R");
  settings.layout = DroLayout::whole_points;
  EXPECT_NE(parse_dro_line("Y=-   1.2000 R", settings, line).message, "");
  settings.layout = DroLayout::single_axes;
  EXPECT_NE(parse_dro_line("X 1.0 Y 2.0 Z 3.0", settings, line).message, "");
}

TEST(DroLine, TellsWhetherALostBeginningWouldShow) {
  DroSettings settings;
  settings.labels = false;
  DroLine line;
  for (const auto& [text, shows] :
       {std::pair{"3.5 1.5 2.5", false}, {"+3.5 1.5 2.5", true}, {" 3.5 1.5 2.5", true}, {"- 3.5 1.5 2.5", true}}) {
    ASSERT_EQ(parse_dro_line(text, settings, line).message, "");
    EXPECT_EQ(line.shows_its_beginning, shows) << text;
  }
}

}  // namespace
}  // namespace bladefit
