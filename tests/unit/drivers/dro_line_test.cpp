#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>

#include "drivers/dro/dro_line.hpp"

namespace bladefit {
namespace {

struct DroCase {
  const char* line;
  const char* error;  ///< part of the message; empty = the line is good
};

class DroLines : public testing::TestWithParam<DroCase> {};

TEST_P(DroLines, AreReadOrRefused) {
  std::array<double, 3> position{};
  const std::string error = parse_dro_line(GetParam().line, DroSettings{}, position).message;
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
  ASSERT_EQ(parse_dro_line("1,5; 2 ;-3", settings, position).message, "");
  EXPECT_EQ(position, (std::array<double, 3>{2 * 25.4, -3 * 25.4, 1.5 * 25.4}));
  EXPECT_NE(parse_dro_line("1.5; 2 ;-3", settings, position).message, "");
}

}  // namespace
}  // namespace bladefit
