// The HMI projects that are shipped read the registers that the panel serves.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>

#include "firmware_bridge/host/panel/panel_map.hpp"
#include "tools/panel/panel_map_text.hpp"

namespace bladefit {
namespace {

using Json = nlohmann::json;

struct Register {
  std::size_t address = 0, count = 0;
  std::string input, holding, type;
};

/// The printed map by name.
const std::map<std::string, Register>& registers() {
  static const std::map<std::string, Register> rows = [] {
    std::map<std::string, Register> read;
    std::istringstream lines(panel_map_csv());
    const std::regex row("registers,([0-9]+),([0-9]+),([0-9]+),([0-9]+),([a-z0-9]+),[^,]*,([a-z0-9_]+),.*");
    for (std::string line; std::getline(lines, line);) {
      std::smatch cells;
      if (!std::regex_match(line, cells, row)) continue;
      read[cells[6]] = {std::stoul(cells[1]), std::stoul(cells[4]), cells[2], cells[3], cells[5]};
    }
    return read;
  }();
  return rows;
}

std::string hmi_file(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(std::string(BLADEFIT_TEST_DATA) + "/../../config/hmi/" + name).rdbuf();
  return text.str();
}

const Json& node_of(const Json& flow, const std::string& id) {
  for (const Json& node : flow) {
    if (node.at("id") == id) return node;
  }
  throw std::out_of_range(id);
}

TEST(HmiFiles, TheFuxaProjectHasTheAddressesOfTheMap) {
  const Json project = Json::parse(hmi_file("fuxa_project.json"));
  const Json& tags = project.at("devices").at("d_bladefit").at("tags");
  const std::map<std::string, std::string> types = {{"uint16", "UInt16"}, {"uint32", "UInt32"}, {"float32", "Float32"}};
  EXPECT_GE(tags.size(), 12U);
  for (const auto& [id, tag] : tags.items()) {
    const Register& expected = registers().at(tag.at("name"));
    EXPECT_EQ(tag.at("id"), id);
    EXPECT_EQ(tag.at("memaddress"), "300000") << id;
    EXPECT_EQ(tag.at("address"), std::to_string(expected.address + 1)) << id;
    EXPECT_EQ(tag.at("type"), types.at(expected.type)) << id;
  }
  const Json& view = project.at("hmi").at("views").at(0);
  for (const auto& [id, item] : view.at("items").items()) {
    EXPECT_TRUE(tags.contains(item.at("property").at("variableId").get<std::string>())) << id;
    EXPECT_NE(view.at("svgcontent").get<std::string>().find("id=\"" + id + "\""), std::string::npos) << id;
  }
}

TEST(HmiFiles, TheNodeRedFlowHasTheAddressesOfTheMap) {
  const Json flow = Json::parse(hmi_file("node_red_flow.json"));
  std::vector<std::pair<std::size_t, std::size_t>> blocks;
  for (const Json& node : flow) {
    if (node.at("type") != "modbus-read") continue;
    const std::size_t first = std::stoul(node.at("adr").get<std::string>());
    const std::size_t count = std::stoul(node.at("quantity").get<std::string>());
    EXPECT_EQ(node.at("topic"), node.at("adr")) << "by which the flow knows the block";
    EXPECT_EQ(node.at("dataType"), "InputRegister");
    EXPECT_LE(count, 125U);
    EXPECT_TRUE(PanelImage::can_read(first, count));
    blocks.emplace_back(first, first + count);
  }
  const std::string code = node_of(flow, "bf-decode").at("func");
  const std::size_t begin = code.find("const map = ") + 12;
  const Json map = Json::parse(code.substr(begin, code.find(';', begin) - begin));
  EXPECT_GE(map.size(), 15U);
  for (const auto& [name, place] : map.items()) {
    const Register& expected = registers().at(name);
    EXPECT_EQ(place.at(0), expected.address) << name;
    EXPECT_EQ(place.at(1), expected.type) << name;
    EXPECT_TRUE(std::ranges::any_of(blocks,
                                    [&](const auto& block) {
                                      return expected.address >= block.first &&
                                             expected.address + expected.count <= block.second;
                                    }))
        << name << " is not read";
  }
}

TEST(HmiFiles, TheTableOfTheReadmeIsThatOfTheMap) {
  std::istringstream lines(hmi_file("README.md"));
  const std::regex row("\\| `([a-z0-9_]+)` \\| ([0-9]+) \\| ([0-9]+) \\| ([0-9]+) \\| ([a-z0-9]+) \\|.*");
  int rows = 0;
  for (std::string line; std::getline(lines, line);) {
    std::smatch cells;
    if (!std::regex_match(line, cells, row)) continue;
    ++rows;
    const Register& expected = registers().at(cells[1]);
    EXPECT_EQ(std::stoul(cells[2]), expected.address) << line;
    EXPECT_EQ(cells[3], expected.input) << line;
    EXPECT_EQ(cells[4], expected.holding) << line;
    EXPECT_EQ(cells[5], expected.type) << line;
  }
  EXPECT_GE(rows, 12);
}

TEST(HmiFiles, TheReadmeNamesTheVerdictsAddressOfEachMaker) {
  const std::string text = hmi_file("README.md");
  const Register& verdict = registers().at("verdict");
  for (const std::string& words :
       {"3x-" + std::to_string(verdict.address + 1), "4x" + verdict.holding, "`verdict` is " + verdict.input}) {
    EXPECT_NE(text.find(words), std::string::npos) << words;
  }
}

}  // namespace
}  // namespace bladefit
