// Weights, locks, robust losses and start pairs by the real command, and what it says of wrong ones.

#include <gtest/gtest.h>

#include <fstream>

#include "tests/golden/golden_case.hpp"

namespace bladefit::testing {
namespace {

class FitChoices : public GoldenCase {
 protected:
  FitChoices() : case_(read_case("dtmb4119")), points_((case_.folder / "subsets/200.csv").string()) {
    const Outcome compiled = run({BLADEFIT_COMMAND, "compile", case_.folder / "design.igs", "-o", scratch("design.bfd"),
                                  "--outward", sign_text(case_)});
    EXPECT_EQ(compiled.exit_code, 0) << compiled.output;
  }

  [[nodiscard]] Outcome localize(const std::vector<std::string>& options) const {
    return run(with({BLADEFIT_COMMAND, "localize", "--design", scratch("design.bfd"), "--json", scratch("result.json")},
                    options));
  }

  [[nodiscard]] std::string written(const std::string& name, const std::string& text) const {
    std::ofstream(scratch(name)) << text;
    return scratch(name);
  }

  /// Exit code 2, and one line that holds each of `parts`.
  void expect_refusal(const std::vector<std::string>& options, const std::vector<std::string>& parts) const {
    const Outcome outcome = localize(with({"--points", points_}, options));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    for (const std::string& part : parts) EXPECT_NE(outcome.output.find(part), std::string::npos) << outcome.output;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(scratch("result.json")));
  }

  ReferenceCase case_;
  std::string points_;
};

TEST_F(FitChoices, LockedDegreesOfFreedomKeepTheirValue) {
  const Outcome outcome = localize({"--points", points_, "--lock", "ty,rx"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("Locked at the start value: ty, rx"), std::string::npos) << outcome.output;
  const nlohmann::json result = read_json(scratch("result.json"));
  EXPECT_EQ(result["status"], "converged");
  EXPECT_EQ(result["pose"]["translation"][1], 0.0);
  EXPECT_NEAR(result["pose"]["euler"]["psi"].get<double>(), 0.0, 1e-16);
  EXPECT_NE(result["pose"]["euler"]["theta"], 0.0);
  EXPECT_EQ(result["locked"], nlohmann::json({"ty", "rx"}));
}

TEST_F(FitChoices, PairsAreWhereTheFitStarts) {
  // A quarter turn about x: hopeless without them.
  std::ifstream in(points_);
  std::string turned = "x,y,z\n", line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    double p[3];
    std::sscanf(line.c_str(), "%lf,%lf,%lf", &p[0], &p[1], &p[2]);
    turned += fmt::format("{},{},{}\n", p[0], -p[2], p[1]);
  }
  const std::string pairs = written("pairs.csv",
                                    "# three marks\nname,x,y,z,design_x,design_y,design_z\nA,0,-10,100,0,100,10\n"
                                    "B,20,-15,60,20,60,15\nC,-30,40,40,-30,40,-40\n");
  const Outcome outcome = localize({"--points", written("turned.csv", turned), "--start", pairs});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("Start: 3 point pairs"), std::string::npos) << outcome.output;
  const nlohmann::json result = read_json(scratch("result.json"));
  EXPECT_EQ(result["status"], "converged");
  EXPECT_LT(result["summary"]["rms_after"].get<double>(), 0.06);
}

/// What is told of the time before the fit is of the points as measured, so the reference solution has the same.
TEST_F(FitChoices, FiguresBeforeTheFitAreNotThoseAtTheStartPose) {
  const std::string pairs = written("pairs.csv",
                                    "x,y,z,design_x,design_y,design_z\n0,0,0,0.3,0.1,0\n100,0,0,100.3,0.1,0\n"
                                    "0,100,0,0.3,100.1,0\n");
  expect_truth(
      case_, case_.subsets.at(1), scratch("design.bfd"),
      with(fit_options(case_, case_.unit), {"--points", case_.subsets.at(1).points.string(), "--start", pairs}));
}

TEST_F(FitChoices, OutliersAreNamedAndARobustLossLeavesThemBehind) {
  std::ifstream in(points_);
  std::string text, line;
  std::getline(in, line);
  text = line + ",weight\n";
  for (int row = 0; std::getline(in, line); ++row) {
    // Row 17 is moved, the weights leave it what it is.
    const std::size_t comma = line.find(',');
    if (row == 17) line = fmt::format("{}", std::stod(line.substr(0, comma)) + 3.0) + line.substr(comma);
    text += line + ",2\n";
  }
  const std::string points = written("outliers.csv", text);
  const Outcome plain = localize({"--points", points});
  ASSERT_EQ(plain.exit_code, 0) << plain.output;
  const nlohmann::json before = read_json(scratch("result.json"));
  ASSERT_GE(before["aberrant"]["points"].size(), 1U) << plain.output;
  EXPECT_EQ(before["aberrant"]["points"][0]["index"], 17);
  EXPECT_TRUE(before["loss"].is_null());
  const Outcome robust = localize({"--points", points, "--loss", "tukey"});
  ASSERT_EQ(robust.exit_code, 0) << robust.output;
  const nlohmann::json after = read_json(scratch("result.json"));
  EXPECT_EQ(after["loss"]["name"], "tukey");
  EXPECT_EQ(after["aberrant"]["points"][0]["index"], 17);
  EXPECT_NE(robust.output.find("18 ("), std::string::npos) << robust.output;
}

TEST_F(FitChoices, WrongOnesAreRefused) {
  expect_refusal({"--lock", "tx,qq"}, {"--lock", "'qq'", "tx,ty,tz,rx,ry,rz"});
  expect_refusal({"--lock", "tx,ty,tz,rx,ry,rz"}, {"--lock", "all six"});
  expect_refusal({"--ratio", "inf", "--tolerance", "1"}, {"--ratio: inf", "give a number from 1 to"});
  expect_refusal({"--ratio", "nan", "--tolerance", "1"}, {"--ratio: nan", "give a number from 1 to"});
  expect_refusal({"--tolerance", "1e300"}, {"--tolerance: 1e+300", "give one above 0"});
  expect_refusal({"--probe-radius", "1e308", "--units", "in"}, {"--probe-radius: 1e+308", "give 0 or more"});
  expect_refusal({"--subset", scratch("")}, {"is a folder; name a file in it (the subset)"});
  expect_refusal({"--loss", "cauchy"}, {"--loss: 'cauchy'", "none, huber, tukey"});
  expect_refusal({"--loss-scale", "1"}, {"--loss-scale", "add --loss"});
  expect_refusal({"--loss", "huber", "--mode", "minimax"}, {"--loss huber", "least_squares"});
  expect_refusal({"--start", scratch("missing.csv")}, {"missing.csv"});
  const std::string header = "x,y,z,design_x,design_y,design_z\n";
  expect_refusal({"--start", written("two.csv", header + "0,0,0,0,0,0\n1,0,0,1,0,0\n")}, {"two.csv", "at least 3"});
  expect_refusal({"--start", written("line.csv", header + "0,0,0,0,0,0\n1,0,0,1,0,0\n2,0,0,2,0,0\n")},
                 {"line.csv", "in one line"});
  expect_refusal({"--start", written("word.csv", header + "0,0,zero,0,0,0\n")}, {"word.csv:2", "column z", "'zero'"});
  expect_refusal(
      {"--start", written("apart.csv", header + "0,0,0,0,0,0\n100,0,0,100,0,0\n0,100,0,0,0,100\n0,0,50,0,50,0\n")},
      {"apart.csv", "do not fit each other", "line 3 "});
  expect_refusal({"--start", "search", "--lock", "tx"}, {"--start search", "--lock"});
  expect_refusal({"--axis", "1,2,3"}, {"--axis", "x0,y0,z0,i,j,k"});
  expect_refusal({"--tip-radius", "0"}, {"--tip-radius: 0"});
  expect_refusal({"--probe-radius", "500"}, {"--probe-radius", "larger than the blade"});
  expect_refusal({"--start", written("head.csv", "x,y,z\n0,0,0\n")}, {"head.csv:1", "design_x"});
}

TEST_F(FitChoices, AWeightMustBeAboveZero) {
  for (const std::string weight : {"0", "-2", "much"}) {
    const Outcome outcome = localize({"--points", written("w.csv", "x,y,z,weight\n1,2,3,1\n1,2,4," + weight + "\n")});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find("w.csv:3: column weight"), std::string::npos) << outcome.output;
  }
}

}  // namespace
}  // namespace bladefit::testing
