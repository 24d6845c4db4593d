#pragma once
#include <filesystem>
#include <string>
#include <vector>

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

std::vector<std::string> reference_case_names();

ReferenceCase read_case(const std::string& name);

}  // namespace bladefit::testing
