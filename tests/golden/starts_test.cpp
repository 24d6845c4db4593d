// However the first feet are found, the fit is that of the reference.

#include <gtest/gtest.h>

#include "tests/golden/golden_case.hpp"

namespace bladefit::testing {
namespace {

class GoldenStarts : public GoldenCase, public ::testing::WithParamInterface<std::string> {};

TEST_P(GoldenStarts, EveryWayGivesTheSamePose) {
  for (const std::string name : {"arl_fan", "arl_3patch", "pnsy_sub", "dtmb4119_ball"}) {
    const ReferenceCase c = read_case(name);
    const std::string design = scratch("design.bfd");
    const Outcome compiled =
        run({BLADEFIT_COMMAND, "compile", c.folder / "design.igs", "-o", design, "--outward", sign_text(c)});
    ASSERT_EQ(compiled.exit_code, 0) << compiled.output;
    for (const ReferenceSubset& subset : c.subsets) {
      // Of arl_fan the 41 points and all of them go astray where their feet are only tracked.
      expect_truth(c, subset, design,
                   with(fit_options(c, c.unit), {"--points", subset.points, "--starts", GetParam()}));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, GoldenStarts, ::testing::Values("curves", "neighbour", "global"),
                         [](const auto& one) { return one.param; });

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
