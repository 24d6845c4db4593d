// However the first feet are found, the fit is that of the reference.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/golden/golden_case.hpp"

namespace bladefit::testing {
namespace {

/// Subsets of a case, few of many.
struct StartsCase {
  std::string name;
  std::vector<std::string> subsets;
};

class GoldenStarts : public GoldenCase, public ::testing::WithParamInterface<StartsCase> {};

TEST_P(GoldenStarts, EveryWayGivesTheSamePose) {
  const ReferenceCase c = read_case(GetParam().name);
  const std::string design = scratch("design.bfd");
  const Outcome compiled =
      run({BLADEFIT_COMMAND, "compile", c.folder / "design.igs", "-o", design, "--outward", sign_text(c)});
  ASSERT_EQ(compiled.exit_code, 0) << compiled.output;
  for (const ReferenceSubset& subset : c.subsets) {
    const auto& wanted = GetParam().subsets;
    if (std::find(wanted.begin(), wanted.end(), subset.name) == wanted.end()) continue;
    for (const std::string way : {"curves", "neighbour", "global"}) {
      expect_truth(c, subset, design, with(fit_options(c, c.unit), {"--points", subset.points, "--starts", way}));
    }
  }
}

// Of arl_fan the 41 points and all of them go astray where their feet are only tracked; dtmb4119_ball has directions.
INSTANTIATE_TEST_SUITE_P(Cases, GoldenStarts,
                         ::testing::Values(StartsCase{"arl_fan", {"041", "full", "all"}},
                                           StartsCase{"arl_3patch", {"102"}}, StartsCase{"pnsy_sub", {"101"}},
                                           StartsCase{"dtmb4119_ball", {"050"}}),
                         [](const auto& one) { return one.param.name; });

/// The modes go on from the least-squares pose, so they are the same as well.
TEST_F(GoldenCase, ConstrainedFitsFromCurvesAreTheSame) {
  const ReferenceCase c = read_case("pnsy_sub");
  const ReferenceSubset& subset = c.subsets[1];
  const nlohmann::json truth = read_json(subset.truth);
  for (const std::string mode : {"min_tolerance", "constrained"}) {
    const double epsilon = truth["constrained"]["epsilon"];
    expect_truth(c, subset, c.folder / "design.igs",
                 with(fit_options(c, c.unit),
                      {"--points", subset.points, "--starts", "curves", "--regions", "fixed", "--mode", mode,
                       "--outward", sign_text(c), "--tolerance", fmt::format("{}", epsilon), "--ratio", "10"}));
  }
}

/// Points without paths are one pass; whatever it is like, the fit is the same.
TEST_F(GoldenCase, PointsWithoutPathsAreOnePass) {
  const ReferenceCase c = read_case("arl_fan");
  const ReferenceSubset& subset = c.subsets.front();
  std::ifstream in(subset.points);
  std::ofstream out(scratch("points.csv"));
  for (std::string line; std::getline(in, line);) out << line.substr(0, line.rfind(',')) << "\n";
  out.close();
  expect_truth(c, subset, c.folder / "design.igs",
               with(fit_options(c, c.unit),
                    {"--points", scratch("points.csv"), "--starts", "curves", "--outward", sign_text(c)}));
}

TEST_F(GoldenCase, UnknownWaysToStartAreRefused) {
  const ReferenceCase c = read_case("arl_fan");
  const Outcome outcome = run({BLADEFIT_COMMAND, "localize", "--design", c.folder / "design.igs", "--points",
                               c.subsets.front().points, "--starts", "nowhere"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.output.find("--starts nowhere: give curves, neighbour or global"), std::string::npos)
      << outcome.output;
}

}  // namespace
}  // namespace bladefit::testing
