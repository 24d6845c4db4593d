#pragma once
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tools/design/load_design.hpp"

namespace bladefit::testing {

/// Points of a case with a reference solution.
struct ReferenceSubset {
  std::string name;
  std::filesystem::path points;   ///< of the whole case where the subset has no file of its own
  std::filesystem::path indices;  ///< rows of the case's points.csv; empty where there is no such file
  std::filesystem::path truth;
};

/// One case of tests/data, as its case.json describes it.
struct ReferenceCase {
  std::string name;
  std::filesystem::path folder;
  std::string unit;  ///< mm or in
  double mm_per_unit = 1;
  int normal_sign = 1;
  double probe_radius = 0;  ///< [unit]
  bool use_approach = false;
  struct Box {
    unsigned patch;
    double u[2], v[2];
  };
  std::vector<Box> leading_edge;
  std::vector<ReferenceSubset> subsets;
};

inline std::vector<std::string> reference_case_names() {
  return {"arl_3patch", "arl_fan", "dtmb4119", "dtmb4119_ball", "pnsy_3patch", "pnsy_sub"};
}

inline nlohmann::json read_json(const std::filesystem::path& path) {
  std::ifstream stream(path);
  return nlohmann::json::parse(stream);
}

inline ReferenceSubset read_subset(const nlohmann::json& entry, const std::filesystem::path& folder) {
  ReferenceSubset subset;
  subset.name = entry.at("name");
  subset.points = folder / entry.at("points").get<std::string>();
  subset.truth = folder / entry.at("truth").get<std::string>();
  const std::filesystem::path indices = folder / "subsets" / (subset.name + ".txt");
  if (std::filesystem::exists(indices)) subset.indices = indices;
  return subset;
}

inline ReferenceCase read_case(const std::string& name) {
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

inline OutwardOption outward_of(const ReferenceCase& c) {
  return c.normal_sign > 0 ? OutwardOption::plus : OutwardOption::minus;
}

}  // namespace bladefit::testing
