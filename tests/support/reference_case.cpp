#include "tests/support/reference_case.hpp"

#include "tests/support/json_file.hpp"

namespace bladefit::testing {
namespace {

ReferenceSubset read_subset(const nlohmann::json& entry, const std::filesystem::path& folder) {
  ReferenceSubset subset;
  subset.name = entry.at("name");
  subset.points = folder / entry.at("points").get<std::string>();
  subset.truth = folder / entry.at("truth").get<std::string>();
  const std::filesystem::path indices = folder / "subsets" / (subset.name + ".txt");
  if (std::filesystem::exists(indices)) subset.indices = indices;
  return subset;
}

}  // namespace

std::vector<std::string> reference_case_names() {
  return {"arl_3patch", "arl_fan", "dtmb4119", "dtmb4119_ball", "pnsy_3patch", "pnsy_sub"};
}

ReferenceCase read_case(const std::string& name) {
  ReferenceCase c;
  c.name = name;
  c.folder = std::filesystem::path(BLADEFIT_TEST_DATA) / name;
  const nlohmann::json json = read_json(c.folder / "case.json");
  c.unit = json.at("units");
  c.mm_per_unit = c.unit == "in" ? 25.4 : 1.0;
  c.normal_sign = json.at("design").at("normal_sign");
  c.probe_radius = json.at("probe_radius");
  c.use_approach = json.at("use_approach");
  for (const nlohmann::json& b : json.at("leading_edge").at("boxes")) {
    c.leading_edge.push_back({b.at("patch"), {b.at("u")[0], b.at("u")[1]}, {b.at("v")[0], b.at("v")[1]}});
  }
  for (const nlohmann::json& entry : json.at("subsets")) c.subsets.push_back(read_subset(entry, c.folder));
  return c;
}

}  // namespace bladefit::testing
