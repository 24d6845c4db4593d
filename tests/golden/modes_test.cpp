// Minimax, range, smallest tolerance and constrained optimum by the real command, against the independent optima of
// every case and subset; infeasible tolerances.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/golden/golden_case.hpp"

namespace bladefit::testing {
namespace {

class GoldenModes : public GoldenCase, public ::testing::WithParamInterface<std::string> {
 protected:
  GoldenModes() : case_(read_case(GetParam())), design_(scratch("design.bfd")) {
    const Outcome compiled =
        run({BLADEFIT_COMMAND, "compile", case_.folder / "design.igs", "-o", design_, "--outward", sign_text(case_)});
    EXPECT_EQ(compiled.exit_code, 0) << compiled.output;
  }

  [[nodiscard]] Outcome fit(const ReferenceSubset& subset, const std::string& mode,
                            const std::vector<std::string>& more) const {
    return run(with(with({BLADEFIT_COMMAND, "localize", "--design", design_, "--points", subset.points, "--mode", mode,
                          "--regions", "fixed", "--json", scratch("result.json")},
                         fit_options(case_, case_.unit)),
                    more));
  }

  static std::vector<std::string> tolerances(double epsilon, double delta) {
    return {"--tolerance", fmt::format("{}", epsilon), "--rest-tolerance", fmt::format("{}", delta)};
  }

  ReferenceCase case_;
  std::string design_;
};

TEST_P(GoldenModes, EveryOptimumAgreesWithItsTruth) {
  for (const ReferenceSubset& subset : case_.subsets) {
    const nlohmann::json truth = read_json(subset.truth);
    for (const std::string mode : {"minimax", "range", "min_tolerance", "constrained"}) {
      if (!truth.contains(mode)) continue;
      std::vector<std::string> more;
      if (mode == "constrained") more = tolerances(truth[mode]["epsilon"], truth[mode]["delta"]);
      const Outcome outcome = fit(subset, mode, more);
      expect_decided_or_pending(outcome, scratch("result.json"));
      const Outcome check = run({"python3", BLADEFIT_TEST_DATA "/check.py", subset.truth, scratch("result.json")});
      EXPECT_EQ(check.exit_code, 0) << case_.name << "/" << subset.name << " " << mode << ": " << check.output;
    }
  }
}

/// A tenth below the smallest tolerance: refused, with the smallest one and the points that prove it.
TEST_P(GoldenModes, AnInfeasibleToleranceIsProvenToBeOne) {
  for (const ReferenceSubset& subset : case_.subsets) {
    const nlohmann::json truth = read_json(subset.truth);
    if (!truth.contains("min_tolerance")) continue;
    const double smallest = truth["min_tolerance"]["epsilon"];
    const Outcome outcome = fit(subset, "constrained", tolerances(0.9 * smallest, 9.0 * smallest));
    EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
    EXPECT_NE(outcome.output.find("cannot be brought within"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("and the rest tolerance in the same ratio"), std::string::npos) << outcome.output;
    const nlohmann::json result = read_json(scratch("result.json"));
    EXPECT_EQ(result["status"], "infeasible");
    EXPECT_NEAR(result["tolerance_factor"].get<double>(), smallest, 1e-8 * smallest);
    std::vector<std::size_t> points = result["certificate"]["points"];
    std::vector<std::size_t> support = truth["min_tolerance"]["support"]["points"];
    std::sort(points.begin(), points.end());
    std::sort(support.begin(), support.end());
    EXPECT_EQ(points, support) << case_.name << "/" << subset.name;
  }
}

INSTANTIATE_TEST_SUITE_P(AllCases, GoldenModes, ::testing::ValuesIn(reference_case_names()),
                         [](const auto& one) { return one.param; });

class GoldenModeOptions : public GoldenCase {};

/// Regions that follow the feet come to rest where every point has the bound of its own place.
TEST_F(GoldenModeOptions, RegionsFollowTheFeet) {
  const ReferenceCase c = read_case("dtmb4119");
  const std::string result = scratch("result.json");
  for (const std::string transition : {"0", "0.05"}) {
    const Outcome outcome = run(
        with({BLADEFIT_COMMAND, "localize", "--design", c.folder / "design.igs", "--outward", sign_text(c), "--points",
              c.folder / "points.csv", "--mode", "min_tolerance", "--transition", transition, "--json", result},
             fit_options(c, c.unit)));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const nlohmann::json json = read_json(result);
    ASSERT_EQ(json["status"], "converged") << transition;
    const double epsilon = json["tolerance_factor"], width = std::stod(transition);
    double reached = 0;
    for (const nlohmann::json& point : json["points"]) {
      const double u = point["u"], outside = std::max({c.leading_edge[0].u[0] - u, u - c.leading_edge[0].u[1], 0.0});
      const double weight = outside == 0.0 ? 1.0 : outside >= width ? 10.0 : 1.0 + 9.0 * outside / width;
      const double share = std::abs(point["distance"].get<double>()) / (epsilon * weight);
      EXPECT_LT(share, 1.0 + 1e-8);
      reached = std::max(reached, share);
    }
    EXPECT_GT(reached, 1.0 - 1e-8);
  }
}

/// Without boxes, or without a tolerance in them, one tolerance holds for the whole blade: what is told is compared
/// with that one, and is the smallest that can be met.
TEST_F(GoldenModeOptions, OneInfeasibleTolerance) {
  const ReferenceCase c = read_case("arl_fan");
  const std::string result = scratch("result.json");
  const auto constrained = [&](const std::vector<std::string>& more) {
    return run(with({BLADEFIT_COMMAND, "localize", "--design", c.folder / "design.igs", "--points",
                     c.folder / "subsets/061.csv", "--mode", "constrained", "--json", result},
                    more));
  };
  const double least = read_json(c.folder / "truth/061.json")["minimax"]["value"];
  const Outcome both = constrained({"--tolerance", "0.001"});
  EXPECT_EQ(both.exit_code, 1) << both.output;
  EXPECT_NE(both.output.find(fmt::format("cannot be brought within 0.01 in together; the least feasible rest tolerance "
                                         "is {:.6g} in.\nMeasure these points again, or widen the rest tolerance by "
                                         "{:.6g} in\n",
                                         least, least - 0.01)),
            std::string::npos)
      << both.output;
  EXPECT_NEAR(read_json(result)["tolerance_factor"].get<double>(), 0.1 * least, 1e-8 * least);
  expect_decided_or_pending(constrained({"--tolerance", fmt::format("{}", 0.1 * least * (1 + 1e-6))}), result);

  const Outcome rest = constrained({"--rest-tolerance", "0.01"});
  EXPECT_EQ(rest.exit_code, 1) << rest.output;
  EXPECT_NE(rest.output.find("cannot be brought within 0.01 in together"), std::string::npos) << rest.output;
  EXPECT_NE(rest.output.find(fmt::format("widen the rest tolerance by {:.6g} in\n", least - 0.01)), std::string::npos)
      << rest.output;
  EXPECT_NEAR(read_json(result)["tolerance_factor"].get<double>(), least, 1e-8 * least);

  // A leading edge without a tolerance has no bound: only the others count.
  const std::vector<std::string> boxed{"--leading-edge", "u:0.4:0.6", "--rest-tolerance"};
  const Outcome infeasible = constrained(with(boxed, {"0.001"}));
  EXPECT_EQ(infeasible.exit_code, 1) << infeasible.output;
  EXPECT_NE(infeasible.output.find("cannot be brought within 0.001 in together"), std::string::npos)
      << infeasible.output;
  const double smallest = read_json(result)["tolerance_factor"].get<double>();
  EXPECT_LT(smallest, least);
  EXPECT_GT(smallest, 0.001);
  expect_decided_or_pending(constrained(with(boxed, {fmt::format("{}", smallest * (1 + 1e-6))})), result);
  EXPECT_EQ(constrained(with(boxed, {fmt::format("{}", smallest * (1 - 1e-6))})).exit_code, 1);
}

TEST_F(GoldenModeOptions, WhatAModeNeedsIsAskedFor) {
  const ReferenceCase c = read_case("dtmb4119");
  const std::vector<std::string> base{
      BLADEFIT_COMMAND,        "localize",  "--design", c.folder / "design.igs", "--points",
      c.folder / "points.csv", "--outward", "+"};
  const auto refused = [&](const std::vector<std::string>& more, const std::string& word) {
    const Outcome outcome = run(with(base, more));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find(word), std::string::npos) << outcome.output;
  };
  refused({"--mode", "constrained"}, "--tolerance");
  refused({"--mode", "min_tolerance"}, "--leading-edge");
  refused({"--mode", "best"}, "minimax");
  refused({"--mode", "min_tolerance", "--leading-edge", "u:0.4:0.6", "--tolerance", "0.2", "--rest-tolerance", "0.1"},
          "--rest-tolerance");
}

}  // namespace
}  // namespace bladefit::testing
