// What the TOML files of a run and a fit say of units and paths, by the real command.

#include <fstream>

#include "tests/golden/golden_case.hpp"

namespace bladefit::testing {
namespace {

class SettingsFiles : public GoldenCase {
 protected:
  SettingsFiles() : case_(read_case("arl_fan")) {}

  std::string written(const std::string& name, const std::string& text) const {
    std::ofstream(scratch(name)) << text;
    return scratch(name);
  }

  /// The points of a subset of this inch design, in mm.
  void write_points_in_mm(const std::string& name) const {
    std::ifstream in(case_.folder / "subsets/061.csv");
    std::string text = "x,y,z\n", line;
    std::getline(in, line);
    while (std::getline(in, line)) {
      double p[3];
      ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &p[0], &p[1], &p[2]), 3);
      text += fmt::format("{},{},{}\n", 25.4 * p[0], 25.4 * p[1], 25.4 * p[2]);
    }
    written(name, text);
  }

  /// Root mean square after the fit [in] of the points that this session file replays.
  [[nodiscard]] double rms_of(const std::string& session_file, const std::vector<std::string>& options) const {
    const std::string result = scratch("result.json");
    std::filesystem::remove(result);
    const Outcome outcome = run(
        with({BLADEFIT_COMMAND, "run", "--headless", "--panel", "127.0.0.1:0", "--design", case_.folder / "design.igs",
              "--config", session_file, "--session", scratch(fmt::format("s{}", ++sessions_)), "--json", result},
             options));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    if (!std::filesystem::exists(result)) return -1;
    const nlohmann::json json = read_json(result);
    return json["summary"]["rms_after"].get<double>() / (json["units"] == "mm" ? 25.4 : 1.0);
  }

  ReferenceCase case_;
  mutable int sessions_ = 0;
};

TEST_F(SettingsFiles, UnitsOfARecording) {
  write_points_in_mm("mm.csv");
  std::filesystem::copy_file(case_.folder / "subsets/061.csv", scratch("in.csv"));
  const double truth = read_json(case_.folder / "truth/061.json")["least_squares"]["rms"];
  const auto session_of = [this](const std::string& replay) {
    written("device.toml", "kind = \"replay\"\n[replay]\n" + replay);
    return written("session.toml", "device = \"device.toml\"\n[fit]\nignore_approach = true\n");
  };
  EXPECT_NEAR(rms_of(session_of("file = \"mm.csv\"\nunits = \"mm\"\n"), {}), truth, 1e-9);
  EXPECT_NEAR(rms_of(session_of("file = \"in.csv\"\nunits = \"in\"\n"), {}), truth, 1e-9);
  EXPECT_NEAR(rms_of(session_of("file = \"in.csv\"\n"), {}), truth, 1e-9) << "those of the design";
  EXPECT_NEAR(rms_of(session_of("file = \"mm.csv\"\nunits = \"in\"\n"), {"--units", "mm"}), truth, 1e-9)
      << "the flag wins";
}

/// The command runs in another folder than the one with the file.
TEST_F(SettingsFiles, StartPairsAreSoughtBesideTheFile) {
  written("pairs.csv", "x,y,z,design_x,design_y,design_z\n0,0,0,0,0,0\n1,0,0,1,0,0\n0,1,0,0,1,0\n");
  const std::string file = written("fit.toml", "[fit]\nstart = \"pairs.csv\"\n");
  const Outcome outcome = run({BLADEFIT_COMMAND, "localize", "--design", case_.folder / "design.igs", "--points",
                               case_.folder / "subsets/061.csv", "--config", file});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("Start: 3 point pairs"), std::string::npos) << outcome.output;
}

}  // namespace
}  // namespace bladefit::testing
