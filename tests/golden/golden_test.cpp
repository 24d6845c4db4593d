// The real command against the independent reference solutions: every case, every subset, IGES, STEP and compiled.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <tuple>

#include "tests/golden/golden_case.hpp"

namespace bladefit::testing {
namespace {

class GoldenDesign : public GoldenCase, public ::testing::WithParamInterface<std::tuple<std::string, std::string>> {};

TEST_P(GoldenDesign, EverySubsetAgreesWithItsTruth) {
  const ReferenceCase c = read_case(std::get<0>(GetParam()));
  const std::string design = c.folder / ("design." + std::get<1>(GetParam()));
  for (const ReferenceSubset& subset : c.subsets) {
    expect_truth(c, subset, design,
                 with(fit_options(c, c.unit), {"--points", subset.points, "--outward", sign_text(c)}));
  }
}

INSTANTIATE_TEST_SUITE_P(AllCases, GoldenDesign,
                         ::testing::Combine(::testing::ValuesIn(reference_case_names()),
                                            ::testing::Values("igs", "stp")),
                         [](const auto& one) { return std::get<0>(one.param) + "_" + std::get<1>(one.param); });

class GoldenOptions : public GoldenCase, public ::testing::WithParamInterface<std::string> {};

TEST_P(GoldenOptions, CompiledDesignGivesTheSame) {
  const ReferenceCase c = read_case(GetParam());
  const std::string image = scratch("design.bfd");
  const Outcome compiled =
      run({BLADEFIT_COMMAND, "compile", c.folder / "design.igs", "-o", image, "--outward", sign_text(c)});
  ASSERT_EQ(compiled.exit_code, 0) << compiled.output;
  for (const ReferenceSubset& subset : c.subsets) {
    expect_truth(c, subset, image, with(fit_options(c, c.unit), {"--points", subset.points}));
  }
}

TEST_P(GoldenOptions, SubsetByRowNumbersGivesTheSame) {
  const ReferenceCase c = read_case(GetParam());
  for (const ReferenceSubset& subset : c.subsets) {
    if (subset.indices.empty()) continue;
    expect_truth(c, subset, c.folder / "design.igs",
                 with(fit_options(c, c.unit),
                      {"--points", c.folder / "points.csv", "--subset", subset.indices, "--outward", sign_text(c)}));
  }
}

/// The bytes of a compiled image are the same whether its side was found or given.
TEST_P(GoldenOptions, OutwardSideIsFoundFromTheShape) {
  const ReferenceCase c = read_case(GetParam());
  for (const char* outward : {"auto", c.normal_sign > 0 ? "+" : "-"}) {
    const Outcome compiled = run({BLADEFIT_COMMAND, "compile", c.folder / "design.igs", "-o",
                                  scratch(std::string(outward) + ".bfd"), "--outward", outward});
    ASSERT_EQ(compiled.exit_code, 0) << compiled.output;
  }
  EXPECT_EQ(run({"cmp", scratch("auto.bfd"), scratch(sign_text(c) + ".bfd")}).exit_code, 0);
  expect_truth(c, c.subsets.front(), c.folder / "design.stp",
               with(fit_options(c, c.unit), {"--points", c.subsets.front().points, "--outward", "auto"}));
}

/// The points' coordinates are in the units asked for; the result as well, which check.py turns back.
TEST_P(GoldenOptions, OtherUnitsGiveTheSame) {
  const ReferenceCase c = read_case(GetParam());
  const std::string other = c.unit == "in" ? "mm" : "in";
  const double factor = c.unit == "in" ? 25.4 : 1.0 / 25.4;
  const ReferenceSubset& subset = c.subsets.front();
  std::ifstream in(subset.points);
  const std::string converted = scratch("points.csv");
  std::ofstream out(converted);
  std::string line;
  std::getline(in, line);
  out << line << "\n";
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::string field;
    for (int k = 0; std::getline(fields, field, ','); ++k) {
      out << (k > 0 ? "," : "") << (k < 3 ? fmt::format("{}", std::stod(field) * factor) : field);
    }
    out << "\n";
  }
  out.close();
  expect_truth(c, subset, c.folder / "design.igs",
               with(fit_options(c, other), {"--points", converted, "--units", other, "--outward", sign_text(c)}));
  expect_truth(c, subset, c.folder / "design.igs",
               with(fit_options(c, c.unit), {"--points", subset.points, "--units", c.unit, "--outward", sign_text(c)}));
}

INSTANTIATE_TEST_SUITE_P(AllCases, GoldenOptions, ::testing::ValuesIn(reference_case_names()),
                         [](const auto& one) { return one.param; });

/// The thesis' own selection: of all points, those whose foot before the fit lies within 0.05 to 0.95.
TEST_F(GoldenCase, WindowSelectsTheFullSubset) {
  const ReferenceCase c = read_case("arl_fan");
  const auto full = std::find_if(c.subsets.begin(), c.subsets.end(), [](const auto& s) { return s.name == "full"; });
  ASSERT_NE(full, c.subsets.end());
  expect_truth(c, *full, c.folder / "design.igs",
               with(fit_options(c, c.unit), {"--points", c.folder / "points.csv", "--window", "0.05:0.95"}));
}

/// The reference data's checker must be able to say no: a result moved by one part in 10^7 is refused.
TEST_F(GoldenCase, CheckerRefusesAWrongPose) {
  const ReferenceCase c = read_case("arl_fan");
  const std::string result = scratch("result.json");
  ASSERT_EQ(run(with({BLADEFIT_COMMAND, "localize", "--design", c.folder / "design.igs", "--json", result, "--points",
                      c.subsets.front().points, "--outward", "+"},
                     fit_options(c, c.unit)))
                .exit_code,
            0);
  nlohmann::json json = read_json(result);
  json["pose"]["translation"][1] = json["pose"]["translation"][1].get<double>() + 1e-6;
  std::ofstream(result) << json;
  EXPECT_EQ(run({"python3", BLADEFIT_TEST_DATA "/check.py", c.subsets.front().truth, result}).exit_code, 1);
}

}  // namespace
}  // namespace bladefit::testing
