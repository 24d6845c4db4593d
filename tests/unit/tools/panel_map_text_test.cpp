// The printed register map says what the server sends.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "firmware_bridge/host/panel/panel_fields.hpp"
#include "firmware_bridge/host/panel/panel_map.hpp"
#include "tests/support/panel_state.hpp"
#include "tools/panel/panel_map_text.hpp"

namespace bladefit {
namespace {

struct MapRow {
  std::string table;
  std::size_t address = 0, registers = 0;
  std::string input, holding, type, unit, meaning;
};

/// The cells of a line of the map; quotes hold a cell with commas together.
std::vector<std::string> cells_of_row(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char character : line) {
    if (character == '"') {
      quoted = !quoted;
    } else if (character == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += character;
    }
  }
  return cells;
}

std::map<std::string, MapRow> printed_map() {
  std::map<std::string, MapRow> rows;
  std::istringstream lines(panel_map_csv());
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "table,address,input,holding,registers,type,unit,name,meaning");
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = cells_of_row(line);
    EXPECT_EQ(cells.size(), 9U) << line;
    const MapRow row{cells[0], std::stoul(cells[1]), std::stoul(cells[4]), cells[2], cells[3], cells[5], cells[6],
                     cells[8]};
    EXPECT_TRUE(rows.emplace(cells[7], row).second) << "two rows are called " << cells[7];
  }
  return rows;
}

/// The value that a client finds who follows a row.
double value_of(const PanelImage& image, const MapRow& row) {
  const std::uint16_t word = image.registers[row.address];
  if (row.type == "uint16") return word;
  const std::uint32_t bits = static_cast<std::uint32_t>(word) << 16U | image.registers[row.address + 1];
  if (row.type == "uint32") return bits;
  if (row.type == "int32") return static_cast<std::int32_t>(bits);
  return static_cast<double>(std::bit_cast<float>(bits));
}

TEST(PanelMapText, LeadsToTheValuesOfTheState) {
  const PanelState state = testing::known_state();
  const PanelImage image = encode_panel(state, {});
  const std::map<std::string, MapRow> rows = printed_map();
  const std::map<std::string, double> expected = {{"map_version", 1},
                                                  {"points", 70001},
                                                  {"rest_out", 70004},
                                                  {"worst_leading_edge", -0.018F},
                                                  {"worst_leading_edge_twin", -18},
                                                  {"phi", 36},
                                                  {"phi_twin", 36e6},
                                                  {"last_state", 2},
                                                  {"push_latency", 4.9F},
                                                  {"determined", 6},
                                                  {"newest_point_8", 80007},
                                                  {"newest_distance_8", 7.5},
                                                  {"newest_distance_8_twin", 7500},
                                                  {"newest_radius_8", 107},
                                                  {"newest_action_2", 2},
                                                  {"verdict", 2},
                                                  {"reasons", 8},
                                                  {"test_real", 12345.678F},
                                                  {"test_word", 0x12345678}};
  for (const auto& [name, value] : expected) {
    ASSERT_TRUE(rows.contains(name)) << name;
    EXPECT_EQ(value_of(image, rows.at(name)), value) << name;
  }
}

TEST(PanelMapText, NamesEveryRegisterThatIsSentAndNoneTwice) {
  PanelState state = testing::known_state();
  state.texts.fill(std::string(80, 'x'));
  state.improving = state.ended = true;
  state.planned = 0x11112222;
  state.support.fill(0x11112222);
  const PanelImage image = encode_panel(state, {});
  std::set<std::size_t> named;
  for (const auto& [name, row] : printed_map()) {
    if (row.table != "registers") continue;
    EXPECT_EQ(row.input, std::to_string(300001 + row.address)) << name;
    EXPECT_EQ(row.holding, std::to_string(400001 + row.address)) << name;
    for (std::size_t offset = 0; offset < row.registers; ++offset) {
      EXPECT_TRUE(named.insert(row.address + offset).second) << row.address + offset << " in " << name;
    }
  }
  for (std::size_t address = 0; address < image.registers.size(); ++address) {
    EXPECT_TRUE(image.registers[address] == 0 || named.contains(address)) << address;
  }
  for (const std::size_t address : named) EXPECT_TRUE(PanelImage::can_read(address, 1)) << address;
}

TEST(PanelMapText, NamesBitsAndCoils) {
  const std::map<std::string, MapRow> rows = printed_map();
  EXPECT_EQ(rows.at("is_ended").table, "discrete_inputs");
  EXPECT_EQ(rows.at("is_ended").address, 6U);
  EXPECT_EQ(rows.at("is_ended").input, "100007");
  EXPECT_EQ(rows.at("press_acknowledge").table, "coils");
  EXPECT_EQ(rows.at("press_acknowledge").input, "000004");
  EXPECT_NE(rows.at("alarms").meaning.find("bit 0 leading edge out"), std::string::npos);
}

TEST(PanelMapText, HasTheSameRowsInMarkdown) {
  const std::string markdown = panel_map_markdown();
  EXPECT_EQ(std::ranges::count(markdown, '\n') - 11, static_cast<std::ptrdiff_t>(printed_map().size()))
      << markdown.substr(0, 900);
  EXPECT_NE(
      markdown.find("| registers | 281 | 300282 | 400282 | 1 | uint16 |  | verdict | 0 not judged, 1 in tolerance"),
      std::string::npos);
}

}  // namespace
}  // namespace bladefit
