// Which points are judged, by the real command: what holds at the final pose counts, and nothing that was on the way.

#include <gtest/gtest.h>

#include <fstream>

#include "tests/golden/golden_case.hpp"
#include "tests/support/flat_sheets.hpp"
#include "tools/design/nurbs/iges_writer.hpp"

namespace bladefit::testing {
namespace {

/// A section of two sheets, sharp in front and blunt at the back, 100 mm long, open at both ends.
class FinalPose : public GoldenCase {
 protected:
  FinalPose() {
    write_iges_design(scratch("section.igs"), {upper_side_with_tail(), lower_side_with_tail()}, DesignUnit::mm);
    for (int i = 1; i < 10; ++i) {
      for (int j = 1; j < 10; ++j) {
        for (const double side : {1.0, -1.0}) points_.emplace_back(6.0 * i, 10.0 * j, side * half_thickness(6.0 * i));
      }
    }
    good_ = points_.size();
  }

  static double half_thickness(double x) { return x < 30.0 ? x / 6.0 : 1.0 + (60.0 - x) * 4.0 / 30.0; }

  [[nodiscard]] std::string points_file() const {
    std::ofstream file(scratch("points.csv"));
    file << "x,y,z\n";
    for (const Vec3& p : points_) file << fmt::format("{},{},{}\n", p[0], p[1], p[2]);
    return scratch("points.csv");
  }

  [[nodiscard]] Outcome localize(const std::vector<std::string>& options) const {
    return run(with({BLADEFIT_COMMAND,   "localize",   "--design",       scratch("section.igs"),
                     "--outward",        "+",          "--points",       points_file(),
                     "--lock",           "ty",         "--leading-edge", "0:u:0:0.05",
                     "--leading-edge",   "1:u:0.95:1", "--tolerance",    "0.1",
                     "--rest-tolerance", "0.1",        "--json",         scratch("result.json")},
                    options));
  }

  /// The points behind the good ones, and that all of these are in.
  [[nodiscard]] nlohmann::json added() const {
    const nlohmann::json points = read_json(scratch("result.json"))["points"];
    for (std::size_t i = 0; i < good_; ++i) EXPECT_EQ(points[i]["state"], "in") << i;
    nlohmann::json behind = nlohmann::json::array();
    for (std::size_t i = good_; i < points.size(); ++i) behind.push_back(points[i]);
    return behind;
  }

  std::vector<Vec3> points_;
  std::size_t good_ = 0;
};

void expect_says(const Outcome& outcome, const std::string& what) {
  EXPECT_NE(outcome.output.find(what), std::string::npos) << outcome.output;
}

TEST_F(FinalPose, PointsInFrontOfASharpLeadingEdgeAreOutAndCut) {
  for (const double y : {20.0, 50.0, 80.0}) points_.emplace_back(-0.3, y, 0.0);
  for (const char* mode : {"least_squares", "minimax", "constrained"}) {
    const Outcome outcome = localize({"--mode", mode});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
    expect_says(outcome, "3 leading-edge points out");
    for (const nlohmann::json& point : added()) {
      EXPECT_EQ(point["state"], "out");
      EXPECT_EQ(point["action"], "cut");
      EXPECT_EQ(point["kind"], "edge");
      EXPECT_NEAR(point["distance"].get<double>(), 0.3, 1e-6);
    }
  }
}

TEST_F(FinalPose, PointsBeyondTheTipAreAFindingWithNothingToDo) {
  for (const double x : {20.0, 40.0}) points_.emplace_back(x, 100.5, half_thickness(x));
  points_.emplace_back(20.0, 100.05, half_thickness(20.0));
  const Outcome outcome = localize({});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  expect_says(outcome, "2 points lie up to 0.5 mm beyond the edge of the design");
  expect_says(outcome, "1 point is not judged: foot on an outer edge of the design");
  const nlohmann::json points = added();
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_EQ(points[i]["state"], "out");
    EXPECT_EQ(points[i]["action"], "none");
    EXPECT_NEAR(points[i]["beyond"].get<double>(), 0.5, 1e-6);
  }
  EXPECT_EQ(points[2]["state"], "rejected");
  EXPECT_EQ(points[2]["left_out"], "edge");
}

TEST_F(FinalPose, PointsOutsideTheWindowAreToldApart) {
  points_.emplace_back(20.0, 100.5, half_thickness(20.0));
  points_.emplace_back(20.0, 98.0, half_thickness(20.0));
  const Outcome outcome = localize({"--window", "0.05:0.95"});
  EXPECT_EQ(outcome.exit_code, 4) << outcome.output;  // no point is at the leading edge
  expect_says(outcome, "2 points are not judged: foot outside the window before the fit");
  for (const nlohmann::json& point : added()) {
    EXPECT_EQ(point["state"], "rejected");
    EXPECT_EQ(point["left_out"], "window");
  }
}

/// The flat end of a blunt trailing edge, between the ends of both sides, is no excess material.
TEST_F(FinalPose, PointsBetweenTheEndsOfTwoSidesAreNotBeyond) {
  for (const double z : {-0.9, -0.5, 0.1, 0.5, 0.9}) points_.emplace_back(60.0, 50.0, z);
  const Outcome outcome = localize({});
  EXPECT_EQ(outcome.exit_code, 4) << outcome.output;  // no point is at the leading edge
  expect_says(outcome, "5 points are not judged: foot on an outer edge of the design");
  for (const nlohmann::json& point : added()) EXPECT_EQ(point["left_out"], "edge");
}

TEST_F(FinalPose, AStreamJudgesThemAlike) {
  points_.emplace_back(-0.3, 50.0, 0.0);
  points_.emplace_back(20.0, 100.5, half_thickness(20.0));
  points_.emplace_back(60.0, 50.0, 0.1);
  const Outcome outcome = run({BLADEFIT_COMMAND,
                               "run",
                               "--headless",
                               "--panel",
                               "127.0.0.1:0",
                               "--design",
                               scratch("section.igs"),
                               "--outward",
                               "+",
                               "--source",
                               "replay:" + points_file(),
                               "--lock",
                               "ty",
                               "--leading-edge",
                               "0:u:0:0.05",
                               "--leading-edge",
                               "1:u:0.95:1",
                               "--tolerance",
                               "0.1",
                               "--rest-tolerance",
                               "0.1",
                               "--session",
                               scratch("session"),
                               "--json",
                               scratch("result.json")});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  const nlohmann::json points = added();
  EXPECT_EQ(points[0]["action"], "cut");
  EXPECT_EQ(points[1]["state"], "out");
  EXPECT_EQ(points[1]["action"], "none");
  EXPECT_EQ(points[2]["left_out"], "edge");
}

}  // namespace
}  // namespace bladefit::testing
