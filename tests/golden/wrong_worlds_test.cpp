// What the command says of points that do not belong to the design as they are, and how it finds their pose.

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <sstream>

#include "tests/golden/golden_case.hpp"

namespace bladefit::testing {
namespace {

/// The first three cells of a line of points.
using Map = std::array<std::array<double, 3>, 3>;

class WrongWorlds : public GoldenCase {
 protected:
  /// The points of a subset under a linear map of positions, and of directions where there are any.
  std::string mapped(const std::filesystem::path& points, const Map& map, double factor, double shift) const {
    std::ifstream in(points);
    std::string line, text;
    std::getline(in, line);
    text = line + "\n";
    while (std::getline(in, line)) {
      std::vector<double> cells;
      std::stringstream row(line);
      for (std::string cell; std::getline(row, cell, ',');) cells.push_back(std::stod(cell));
      std::vector<double> out = cells;
      for (std::size_t first = 0; first + 3 <= std::min<std::size_t>(cells.size(), 6); first += 3) {
        for (std::size_t i = 0; i < 3; ++i) {
          out[first + i] = first == 0 ? shift : 0.0;
          for (std::size_t k = 0; k < 3; ++k)
            out[first + i] += (first == 0 ? factor : 1.0) * map[i][k] * cells[first + k];
        }
      }
      for (std::size_t k = 0; k < out.size(); ++k)
        text += k < 6 ? fmt::format("{}{:.17g}", k == 0 ? "" : ",", out[k]) : fmt::format(",{:.0f}", out[k]);
      text += "\n";
    }
    const std::string path = scratch("mapped.csv");
    std::ofstream(path) << text;
    return path;
  }

  Outcome localize(const std::string& points, const std::vector<std::string>& more = {}) const {
    const std::string json = scratch("result.json");
    std::filesystem::remove(json);
    return run(with({BLADEFIT_COMMAND, "localize", "--design", case_.folder / "design.igs", "--points", points,
                     "--json", json, "--leading-edge", "u:0.4:0.6", "--tolerance", "0.15", "--rest-tolerance", "0.5"},
                    more));
  }

  void expect_undecided(const Outcome& outcome, const std::vector<std::string>& words) const {
    EXPECT_EQ(outcome.exit_code, 4) << outcome.output;
    for (const std::string& word : words) EXPECT_NE(outcome.output.find(word), std::string::npos) << outcome.output;
    const nlohmann::json result = read_json(scratch("result.json"));
    for (const auto& point : result["points"]) {
      EXPECT_NE(point["state"], "in");
      EXPECT_EQ(point["action"], "none");
    }
  }

  ReferenceCase case_ = read_case("dtmb4119");
  std::filesystem::path points_ = case_.subsets.at(1).points;
  Map same_{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Map turned_{{{0, -1, 0}, {0, 0, -1}, {1, 0, 0}}};
};

TEST_F(WrongWorlds, PointsInAnotherUnitAreNamedWithTheFactor) {
  expect_undecided(localize(mapped(points_, same_, 25.4, 0)), {"25.4 times too large", "--units"});
  expect_undecided(localize(mapped(points_, same_, 1 / 25.4, 0)), {"25.4 times too small", "--units in"});
}

TEST_F(WrongWorlds, MirroredPointsAreNamed) {
  expect_undecided(localize(mapped(points_, {{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}, 1, 0)), {"mirrored"});
}

TEST_F(WrongWorlds, TheSearchGivesTheVerdictsOfPointsThatWereNotMoved) {
  const Outcome plain = localize(points_);
  EXPECT_EQ(plain.exit_code, 0) << plain.output;
  const nlohmann::json wanted = read_json(scratch("result.json"));
  for (const std::vector<std::string>& start : {std::vector<std::string>{"--start", "search"}, {}}) {
    const Outcome outcome = localize(mapped(points_, turned_, 1, 700), start);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("search"), std::string::npos) << outcome.output;
    const nlohmann::json result = read_json(scratch("result.json"));
    for (std::size_t k = 0; k < wanted["points"].size(); ++k) {
      EXPECT_EQ(result["points"][k]["state"], wanted["points"][k]["state"]);
      EXPECT_NEAR(result["points"][k]["distance"].get<double>(), wanted["points"][k]["distance"].get<double>(), 1e-6);
    }
  }
}

TEST_F(WrongWorlds, AnOutwardSideAgainstTheShapeIsRefused) {
  const Outcome outcome = localize(points_, {"--outward", "-"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_NE(outcome.output.find("say --outward +"), std::string::npos) << outcome.output;
}

TEST_F(WrongWorlds, AZoneAlongTheWrongParameterIsWarnedOf) {
  const Outcome outcome = run({BLADEFIT_COMMAND, "localize", "--design", case_.folder / "design.igs", "--points",
                               points_, "--leading-edge", "v:0.4:0.6", "--tolerance", "0.5"});
  EXPECT_NE(outcome.output.find("not where the blade's edge is"), std::string::npos) << outcome.output;
}

TEST_F(WrongWorlds, ASessionCannotSearch) {
  const Outcome outcome = run({BLADEFIT_COMMAND, "run", "--design", case_.folder / "design.igs", "--source",
                               "replay:" + points_.string(), "--session", scratch("session"), "--start", "search"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_NE(outcome.output.find("only localize can search"), std::string::npos) << outcome.output;
}

}  // namespace
}  // namespace bladefit::testing
