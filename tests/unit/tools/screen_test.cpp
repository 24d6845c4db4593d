// The operator's screen: fits a plain terminal, and says everything without colour.
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/panel_state.hpp"
#include "tools/panel/screen.hpp"

namespace bladefit {
namespace {

using testing::known_state;

ScreenView known_view() {
  return {.address = "127.0.0.1:1503",
          .connected = true,
          .known = true,
          .state = known_state(),
          .points_per_second = 199.9,
          .colour = false};
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string without_codes(const std::string& text) {
  std::string plain;
  for (std::size_t index = 0; index < text.size(); ++index) {
    if (text[index] == '\x1b') {
      index = text.find('m', index);
      continue;
    }
    plain += text[index];
  }
  return plain;
}

TEST(BridgeScreen, FitsEightyByTwentyFour) {
  const std::vector<std::string> lines = draw_screen(known_view(), kScreenWidth, kScreenHeight);
  EXPECT_EQ(lines.size(), 24U);
  for (const std::string& line : lines) {
    EXPECT_LE(line.size(), 80U) << line;
    for (const char character : line) EXPECT_TRUE(character >= ' ' && character <= '~') << line;
  }
}

TEST(BridgeScreen, SaysWhatTheOperatorNeeds) {
  const std::string text = joined(draw_screen(known_view(), kScreenWidth, kScreenHeight));
  for (const char* words : {"session tracking", "link LOST", "LEADING EDGE OUT", "70001", "199.9 a second",
                            "6 degrees of freedom", "0.0140 mm", "-0.018 mm at point 70020", "0.045 mm", "80000", "CUT",
                            "WELD", "107.00 mm", "0.6000", "4.9 us", "leading edge: OUT"}) {
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
  }
}

TEST(BridgeScreen, SaysHowManyPointsWillComeWhereThatIsKnown) {
  ScreenView view = known_view();
  view.state.points = 1234;
  view.state.planned = 0;
  EXPECT_EQ(joined(draw_screen(view, kScreenWidth, kScreenHeight)).find("1234 of"), std::string::npos);
  view.state.planned = 70287;
  EXPECT_NE(joined(draw_screen(view, kScreenWidth, kScreenHeight)).find("1234 of 70287"), std::string::npos);
}

TEST(BridgeScreen, NamesThePointsThatCannotBeMetTogether) {
  ScreenView view = known_view();
  view.state.alarms = kAlarmInfeasible | kAlarmLeadingEdgeOut;
  view.state.support = {118, 407, 12, 7, 1999, 1204, 88};
  view.state.smallest_feasible = 0.0134F;
  view.state.improving = true;
  view.state.fit_status = 3;
  const std::string text = joined(draw_screen(view, kScreenWidth, kScreenHeight));
  for (const char* words : {"*** INFEASIBLE by points 118 407 12 7 1999 1204 88, LEADING EDGE", "least 0.0134 mm",
                            "INFEASIBLE, improving"}) {
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
  }
  EXPECT_NE(status_line(view).find("INFEASIBLE by points 118 407"), std::string::npos);
}

TEST(BridgeScreen, ColourChangesNoWord) {
  ScreenView view = known_view();
  const std::string plain = joined(draw_screen(view, kScreenWidth, kScreenHeight));
  view.colour = true;
  const std::string coloured = joined(draw_screen(view, kScreenWidth, kScreenHeight));
  EXPECT_NE(coloured, plain);
  EXPECT_EQ(without_codes(coloured), plain);
}

TEST(BridgeScreen, IsCutToASmallTerminalAndBearsExtremes) {
  ScreenView view = known_view();
  view.state.points = std::numeric_limits<std::uint32_t>::max();
  view.state.worst_leading_edge = -1e30F;
  view.state.rms = std::numeric_limits<float>::quiet_NaN();
  view.state.rest_tolerance = std::numeric_limits<float>::infinity();
  view.state.alarms = 0xFFFF;
  view.state.last_action = static_cast<Action>(77);
  view.state.session = static_cast<SessionState>(77);
  for (const auto& [width, height] : {std::pair{80, 24}, {40, 10}, {1, 1}, {0, 0}, {300, 100}}) {
    const std::vector<std::string> lines = draw_screen(view, width, height);
    EXPECT_LE(lines.size(), static_cast<std::size_t>(height));
    for (const std::string& line : lines) EXPECT_LE(line.size(), static_cast<std::size_t>(width));
  }
}

TEST(BridgeScreen, ShowsADashWhereThePanelHasNoExtension) {
  ScreenView view = known_view();
  view.state.has_extension = false;
  const std::vector<std::string> lines = draw_screen(view, kScreenWidth, kScreenHeight);
  EXPECT_NE(lines[15].find("80000"), std::string::npos) << joined(lines);
  EXPECT_NE(lines[15].find(" - "), std::string::npos);
  EXPECT_EQ(lines[15].find("CUT"), std::string::npos);
}

TEST(BridgeScreen, SaysThatTheHostIsSilent) {
  ScreenView view = known_view();
  view.connected = false;
  EXPECT_NE(draw_screen(view, kScreenWidth, kScreenHeight)[0].find("NO ANSWER"), std::string::npos);
}

TEST(BridgeScreen, OneLineForALog) {
  const std::string line = status_line(known_view());
  EXPECT_EQ(line.find('\n'), std::string::npos);
  for (const char* words : {"tracking", "70001 points", "70003 out", "ALARM LEADING EDGE OUT"}) {
    EXPECT_NE(line.find(words), std::string::npos) << line;
  }
  ScreenView view = known_view();
  view.connected = false;
  EXPECT_NE(status_line(view).find("NO ANSWER"), std::string::npos);
}

}  // namespace
}  // namespace bladefit
