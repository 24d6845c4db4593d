// The operator's screen at the sizes of terminals: what it says, and that it says it without colour, cut or crowded
// numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <regex>
#include <set>

#include "tests/support/panel_state.hpp"
#include "tools/panel/block_letters.hpp"
#include "tools/panel/edge_strip.hpp"
#include "tools/panel/progress_lines.hpp"
#include "tools/panel/screen.hpp"
#include "tools/panel/styled_line.hpp"

namespace bladefit {
namespace {

using testing::known_state;

struct ScreenSize {
  int width, height;
};
constexpr ScreenSize kSmall{60, 15}, kUsual{80, 24}, kLarge{120, 40};

ScreenView known_view() {
  ScreenView view{.address = "127.0.0.1:1503",
                  .connected = true,
                  .known = true,
                  .state = known_state(),
                  .points_per_second = 199.9,
                  .utf8 = true,
                  .keys = "e figures   b big letters   q leaves"};
  view.state.planned = 90000;
  return view;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string drawn(const ScreenView& view, const ScreenSize& size) {
  return joined(draw_screen(view, size.width, size.height));
}

std::string without_codes(const std::string& text) {
  return std::regex_replace(text, std::regex("\x1b\\[[0-9;]*m"), "");
}

void expect_words(const std::string& text, const std::vector<const char*>& words) {
  for (const char* word : words) EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
}

/// Every number of a text, as it is written.
std::multiset<std::string> numbers_of(const std::string& text) {
  const std::regex number("[0-9]+(\\.[0-9]+)?");
  std::multiset<std::string> numbers;
  for (std::sregex_iterator found(text.begin(), text.end(), number), end; found != end; ++found)
    numbers.insert(found->str());
  return numbers;
}

TEST(BridgeScreen, FitsEverySizeAndUsesIt) {
  for (const ScreenPage page : {ScreenPage::operator_page, ScreenPage::figures, ScreenPage::big}) {
    for (const ScreenSize& size : {kSmall, kUsual, kLarge}) {
      ScreenView view = known_view();
      view.page = page;
      const std::vector<std::string> lines = draw_screen(view, size.width, size.height);
      EXPECT_EQ(lines.size(), static_cast<std::size_t>(size.height)) << "the keys stand at the bottom";
      for (const std::string& line : lines) EXPECT_LE(cells_of(line), size.width) << line;
      EXPECT_NE(lines.back().find("e figures"), std::string::npos) << joined(lines);
    }
  }
}

TEST(BridgeScreen, SaysTheMostImportantAtEverySize) {
  for (const ScreenSize& size : {kSmall, kUsual, kLarge}) {
    expect_words(drawn(known_view(), size),
                 {"+0.500 mm CUT", "r/R 0.310", "LINK LOST for 1 min 15 s:", "modbus-tcp://127.0.0.1:1502",
                  "POINTS MISSING: 70108", "70001 of 90000", "1 min 40 s left", "root 0.20[", "]1.00 tip",
                  "0.300-0.310", "cut or weld the points marked, then probe them again"});
  }
}

TEST(BridgeScreen, SaysMoreWhereThereIsRoom) {
  ScreenView view = known_view();
  view.state.alarms = view.state.reasons = 0;
  view.state.verdict = BladeState::not_decided;
  view.state.blade.defect_count = 1;
  std::fill(view.state.blade.defects.begin() + 2, view.state.blade.defects.end(), BladeDefect());
  const std::string usual = drawn(view, kUsual), large = drawn(view, kLarge);
  expect_words(usual, {"probe next", "leading edge near the tip, nose r/R 0.840", "o in", "+ cut", "- weld",
                       "? pending", ". not probed"});
  expect_words(large, {"not probed", "leading edge r/R 0.68-1.00", "suction side r/R 0.6-1.0",
                       "pressure side r/R 0.2-0.3", "x -39.5", "90000", "from r/R 0.2: 12 30 31 32 0 0 0 0"});
  EXPECT_EQ(usual.find("points    worst"), std::string::npos);
  EXPECT_NE(large.find("points    worst"), std::string::npos);
}

TEST(BridgeScreen, ColourChangesNoWord) {
  for (const ScreenPage page : {ScreenPage::operator_page, ScreenPage::figures, ScreenPage::big}) {
    ScreenView view = known_view();
    view.page = page;
    const std::string plain = drawn(view, kUsual);
    EXPECT_EQ(plain.find('\x1b'), std::string::npos);
    view.colour = true;
    EXPECT_NE(drawn(view, kUsual), plain);
    EXPECT_EQ(without_codes(drawn(view, kUsual)), plain);
  }
}

TEST(BridgeScreen, WithoutUtf8ItIsAscii) {
  ScreenView view = known_view();
  view.utf8 = false;
  for (const ScreenPage page : {ScreenPage::operator_page, ScreenPage::figures, ScreenPage::big}) {
    view.page = page;
    for (const char character : drawn(view, kUsual))
      EXPECT_TRUE(character == '\n' || (character >= ' ' && character <= '~'));
  }
}

TEST(BridgeScreen, CutsNoNumber) {
  const std::multiset<std::string> all = numbers_of(drawn(known_view(), {300, 100}));
  for (int width = 20; width < 140; width += 3) {
    for (const std::string& number : numbers_of(drawn(known_view(), {width, 40}))) {
      EXPECT_TRUE(all.contains(number)) << number << " at " << width << "\n" << drawn(known_view(), {width, 40});
    }
  }
}

TEST(BridgeScreen, BearsExtremes) {
  ScreenView view = known_view();
  view.state.points = std::numeric_limits<std::uint32_t>::max();
  view.state.worst_leading_edge = -1e30F;
  view.state.rms = std::numeric_limits<float>::quiet_NaN();
  view.state.rest_tolerance = std::numeric_limits<float>::infinity();
  view.state.alarms = view.state.reasons = 0xFFFF;
  view.state.last_action = static_cast<Action>(77);
  view.state.session = static_cast<SessionState>(77);
  view.state.verdict = static_cast<BladeState>(77);
  view.state.blade.edge.fill(static_cast<EdgeCell>(77));
  view.state.blade.edge_tip = std::numeric_limits<float>::quiet_NaN();
  for (BladeDefect& defect : view.state.blade.defects) {
    defect.distance = -1e30F;
    defect.length = 1e30F;
    defect.from_ratio = std::numeric_limits<float>::infinity();
    defect.machine = {1e30F, -1e30F, std::numeric_limits<float>::quiet_NaN()};
    defect.side = static_cast<BladeSide>(77);
  }
  view.state.texts.fill(std::string(160, 'x'));
  for (const ScreenPage page : {ScreenPage::operator_page, ScreenPage::figures, ScreenPage::big}) {
    view.page = page;
    for (const ScreenSize& size : {kUsual, kSmall, ScreenSize{40, 10}, ScreenSize{1, 1}, ScreenSize{0, 0}, kLarge}) {
      const std::vector<std::string> lines = draw_screen(view, size.width, size.height);
      EXPECT_LE(lines.size(), static_cast<std::size_t>(size.height));
      for (const std::string& line : lines) EXPECT_LE(cells_of(line), size.width) << line;
    }
  }
}

TEST(BridgeScreen, SaysHowOldTheNumbersOfASilentHostAre) {
  ScreenView view = known_view();
  view.connected = false;
  view.age_s = 83;
  view.colour = true;
  const std::string text = drawn(view, kUsual);
  expect_words(text, {"NO ANSWER from 127.0.0.1:1503 for 1 min 23 s"});
  EXPECT_EQ(text.find("\x1b[38;5;36m"), std::string::npos) << "what is old has no colour of meaning";
  EXPECT_NE(text.find("\x1b[2m"), std::string::npos);
}

TEST(BridgeScreen, AHostWithoutTheBladeShowsTheRest) {
  ScreenView view = known_view();
  view.state.has_blade = false;
  const std::string text = drawn(view, kUsual);
  expect_words(text, {"OUT OF TOLERANCE", "70001 of 90000", "+0.022 mm CUT"});
  EXPECT_EQ(text.find("root"), std::string::npos);
  view.state.has_extension = false;
  expect_words(drawn(view, kUsual), {"verdict", "70001"});
}

TEST(BridgeScreen, TellsWhereNothingIsWrong) {
  ScreenView view = known_view();
  view.state = PanelState();
  view.state.has_extension = view.state.has_blade = view.state.ended = true;
  view.state.verdict = BladeState::in_tolerance;
  view.state.points = view.state.planned = 2000;
  view.state.worst_leading_edge = 0.036F;
  view.state.worst_leading_edge_sequence = 12;
  const std::string text = drawn(view, kUsual);
  expect_words(text, {"nothing: the blade is in tolerance", "ended: this is the result", "+0.036 mm", "100 %"});
  EXPECT_EQ(text.find("trouble"), std::string::npos);
}

TEST(BridgeScreen, FiguresNameThePointsThatCannotBeMetTogether) {
  ScreenView view = known_view();
  view.state.alarms = kAlarmInfeasible | kAlarmLeadingEdgeOut;
  view.state.support = {118, 407, 12, 7, 1999, 1204, 88};
  view.state.smallest_feasible = 0.0134F;
  view.state.improving = true;
  view.state.fit_status = 3;
  expect_words(drawn(view, kUsual), {"NO POSE MEETS THE TOLERANCES: proven by points 118 407 12 7 1999"});
  view.page = ScreenPage::figures;
  expect_words(drawn(view, kUsual), {"*** INFEASIBLE by points 118 407 12 7 1999 1204 88", "least 0.0134 mm",
                                     "INFEASIBLE, improving", "80000", "107.00", "4.9 us", "leading edge: OUT"});
  EXPECT_NE(status_line(view).find("INFEASIBLE by points 118 407"), std::string::npos);
}

TEST(BridgeScreen, NamesThePointsThatARobustFitJudgesOtherwise) {
  ScreenView view = known_view();
  view.state.alarms = 0;
  view.state.reasons = kReasonOtherwise;
  view.state.otherwise_count = 34;
  view.state.otherwise = {12, 13};
  expect_words(drawn(view, kUsual), {"A ROBUST FIT JUDGES 34 POINTS OTHERWISE: 12 13 and 32 more;"});
  view.state.reasons = 0;
  EXPECT_EQ(drawn(view, kUsual).find("ROBUST"), std::string::npos);
}

TEST(BridgeScreen, TheStripShowsTheWorstOfAPlace) {
  const BladeView blade = testing::known_blade();
  const std::string signs = edge_signs(blade, 1);
  EXPECT_EQ(signs.size(), 100U);
  EXPECT_EQ(signs.substr(18, 5), "oo++o");
  EXPECT_EQ(signs[40], '-');
  EXPECT_EQ(signs[50], '?');
  EXPECT_EQ(signs.substr(60), std::string(40, '.'));
  EXPECT_EQ(edge_signs(blade, 2).size(), 50U);
  EXPECT_EQ(edge_signs(blade, 3).size(), 34U);
  EXPECT_EQ(edge_signs(blade, 3)[6], '+');
  EXPECT_EQ(edge_signs(blade, 3)[13], '-');
}

TEST(BridgeScreen, TimeLeftIsThatOfTheRate) {
  ScreenView view = known_view();
  view.state.points = 1000;
  view.state.planned = 3000;
  view.points_per_second = 100;
  EXPECT_DOUBLE_EQ(seconds_left(view), 20);
  view.points_per_second = 0;
  EXPECT_LT(seconds_left(view), 0);
  view.state.planned = 0;
  EXPECT_LT(seconds_left(view), 0);
}

TEST(BridgeScreen, BlockLettersAreAsWideAsTheySay) {
  for (const BlockStyle& style : {BlockStyle{1, true}, BlockStyle{1, false}, BlockStyle{3, true}}) {
    const std::vector<std::string> lines = block_letters("OUT -0.323 MM", style);
    EXPECT_EQ(lines.size(), static_cast<std::size_t>(block_rows(style)));
    for (const std::string& line : lines) EXPECT_EQ(cells_of(line), block_width("OUT -0.323 MM", style)) << line;
  }
  EXPECT_EQ(joined(block_letters("1", {1, false})), " # \n## \n # \n # \n###\n");
  EXPECT_EQ(joined(block_letters("1", {1, true})), "▄█ \n █ \n▀▀▀\n");
}

TEST(BridgeScreen, BigLettersFillTheScreen) {
  ScreenView view = known_view();
  view.page = ScreenPage::big;
  view.state.alarms = 0;
  const auto filled = [&](const ScreenSize& size) {
    const std::vector<std::string> lines = draw_screen(view, size.width, size.height);
    return std::ranges::count_if(lines, [](const std::string& line) { return line.find("█") != line.npos; });
  };
  EXPECT_GE(filled(kSmall), 8);
  EXPECT_GE(filled(kLarge), 18);
  view.utf8 = false;
  expect_words(drawn(view, kSmall), {"OUT OF TOLERANCE", "+0.500 MM CUT", "R/R 0.310"});
}

TEST(BridgeScreen, ALineEndsAtABlank) {
  EXPECT_EQ(StyledLine(12, false).add("worst 12.345 mm").text(), "worst>");
  EXPECT_EQ(StyledLine(13, false).add("worst 12.345 mm").text(), "worst 12.345>");
  EXPECT_EQ(StyledLine(5, false).add("12.345").text(), ">");
  EXPECT_EQ(StyledLine(14, false).add("worst").field("12.345").text(), "worst  12.345");
  EXPECT_EQ(StyledLine(12, false).add("worst").field("12.345").text(), "worst");
}

TEST(BridgeScreen, OneLineForALog) {
  const std::string line = status_line(known_view());
  EXPECT_EQ(line.find('\n'), std::string::npos);
  expect_words(line, {"tracking", "70001 points", "70003 out", "ALARM LEADING EDGE OUT"});
  ScreenView view = known_view();
  view.connected = false;
  EXPECT_NE(status_line(view).find("NO ANSWER"), std::string::npos);
}

}  // namespace
}  // namespace bladefit
