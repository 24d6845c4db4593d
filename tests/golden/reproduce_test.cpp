// The thesis' tables on the stand-in data, by the real command, against the independent reference solutions.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/golden/command_fixture.hpp"
#include "tests/support/json_file.hpp"
#include "tests/support/reference_case.hpp"

namespace bladefit::testing {
namespace {

constexpr double kRelative = 1e-8;

class Reproduce : public CommandTest {
 protected:
  [[nodiscard]] nlohmann::json figures(std::vector<std::string> more = {}) const {
    const std::string out = scratch("figures.json");
    more.insert(more.begin(), {BLADEFIT_COMMAND, "reproduce", "--data", BLADEFIT_TEST_DATA, "--json", out});
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return read_json(out);
  }

  static nlohmann::json truth_of(const nlohmann::json& row) {
    const std::string data = row.at("data"), subset = row.at("subset");
    return read_json(std::filesystem::path(BLADEFIT_TEST_DATA) / data / "truth" / (subset + ".json"));
  }
};

void expect_close(double got, double wanted, const std::string& what) {
  EXPECT_NEAR(got, wanted, kRelative * std::abs(wanted)) << what;
}

/// The solution that a row stands for.
const nlohmann::json& solution_of(const nlohmann::json& truth, const std::string& source) {
  if (source == "bladefit") return truth.at("least_squares");
  return truth.at(source == "bladefit, smallest" ? "min_tolerance" : "constrained");
}

void expect_motion(const nlohmann::json& values, const nlohmann::json& pose, const std::string& what) {
  const char* axes[] = {"tx", "ty", "tz"};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(values.at(axes[k]).get<double>(), pose.at("translation")[k].get<double>(), 1e-6) << what;
  }
  for (const char* angle : {"phi", "theta", "psi"}) {
    EXPECT_NEAR(values.at(angle).get<double>(), pose.at("euler").at(angle).get<double>(), 1e-7) << what;
  }
}

/// Which region a table of constrained localization is about: leading_edge, rest, or empty for the whole blade.
std::string region_of(const std::string& title) {
  if (title.find("(Leading Edge)") != std::string::npos) return "leading_edge";
  return title.find("(Non-Leading Edge)") != std::string::npos ? "rest" : "";
}

double rms_of(const nlohmann::json& solution, const std::string& region) {
  return (region.empty() ? solution.at("rms") : solution.at("regions").at(region).at("rms_after")).get<double>();
}

void expect_distances(const nlohmann::json& row, const nlohmann::json& truth, const std::string& region,
                      const std::string& what) {
  const nlohmann::json& values = row.at("values");
  const std::string source = row.at("source");
  const nlohmann::json& solution = solution_of(truth, source);
  const bool constrained = source != "bladefit";
  const double before =
      constrained ? rms_of(truth.at("least_squares"), region) : truth.at("before").at("rms").get<double>();
  expect_close(values.at("rms_before"), before, what);
  expect_close(values.at("rms_after"), rms_of(solution, region), what);
  EXPECT_NEAR(values.at("change_percent").get<double>(), 100 * (rms_of(solution, region) - before) / before, 1e-4)
      << what;
  if (!values.contains("constraint")) return;
  expect_close(values.at("constraint"), solution.at(region == "rest" ? "delta" : "epsilon"), what);
}

TEST_F(Reproduce, EveryFigureAgreesWithItsTruth) {
  const nlohmann::json json = figures();
  std::vector<int> numbers;
  for (const nlohmann::json& table : json.at("tables")) {
    if (!table.contains("number")) continue;
    numbers.push_back(table.at("number"));
    int rows = 0, printed = 0;
    for (const nlohmann::json& row : table.at("rows")) {
      const std::string source = row.at("source");
      if (row.at("label") == "mean") continue;
      if (source == "thesis") {
        ++printed;
        continue;
      }
      ++rows;
      const nlohmann::json truth = truth_of(row);
      const std::string what =
          fmt::format("table {}, {} {}", numbers.back(), row.at("label").get<std::string>(), source);
      const nlohmann::json& values = row.at("values");
      if (values.contains("tx")) expect_motion(values, solution_of(truth, source).at("pose"), what);
      if (values.contains("rms_after")) expect_distances(row, truth, region_of(table.at("title")), what);
    }
    EXPECT_EQ(printed, numbers.back() == 1 ? 6 : 5);
    EXPECT_TRUE(rows == printed || rows == 2 * printed) << rows;
  }
  std::vector<int> wanted(16);
  for (int k = 0; k < 16; ++k) wanted[static_cast<std::size_t>(k)] = k + 1;
  EXPECT_EQ(numbers, wanted);

  const nlohmann::json& checks = json.at("tables")[16];
  EXPECT_EQ(checks.at("rows").size(), 4U);
  for (const nlohmann::json& row : checks.at("rows")) {
    EXPECT_LT(row.at("values").at("translation").get<double>(), 1e-11);
    EXPECT_LT(row.at("values").at("rotation").get<double>(), 1e-12);
  }
  const nlohmann::json& costs = json.at("tables")[17];
  EXPECT_EQ(costs.at("rows").size(), 8U);
  for (const nlohmann::json& row : costs.at("rows")) {
    expect_close(row.at("values").at("rms_after"), truth_of(row).at("least_squares").at("rms"), row.at("source"));
  }
}

/// Figures of the thesis are those of its scan, and where that is torn there is none.
TEST_F(Reproduce, ThesisFiguresStandBesideOurs) {
  const nlohmann::json json = figures({"--table", "iii", "--table", "11"});
  ASSERT_EQ(json.at("tables").size(), 2U);
  const nlohmann::json& first = json.at("tables")[0].at("rows")[0];
  EXPECT_EQ(first.at("source"), "thesis");
  EXPECT_EQ(first.at("values").at("constraint"), 0.012);
  EXPECT_EQ(first.at("values").at("rms_before"), 0.01408);
  EXPECT_EQ(first.at("values").at("cpu_s"), 7);
  const nlohmann::json& torn = json.at("tables")[1].at("rows")[0];
  EXPECT_TRUE(torn.at("values").at("tz").is_null());
  EXPECT_EQ(torn.at("unreadable_in_scan"), (std::vector<std::string>{"tz", "phi", "theta"}));
}

TEST_F(Reproduce, TablesArePrintedInTheThesisForm) {
  const Outcome outcome = run({BLADEFIT_COMMAND, "reproduce", "--data", BLADEFIT_TEST_DATA, "--table", "I"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* piece :
       {"Table I  RMS Distances and Computation Times for Unconstrained Localization of ARL Propeller\n",
        "  21        thesis         0.02371       0.01866     -21.3  0 min 40 sec\n",
        "            bladefit       0.02747       0.01613     -41.3", "67 min 0 sec"}) {
    EXPECT_NE(outcome.output.find(piece), std::string::npos) << piece << "\n" << outcome.output;
  }
  EXPECT_EQ(outcome.output.find("Table II"), std::string::npos);
}

TEST_F(Reproduce, BadInputGetsOneLineThatNamesTheFix) {
  const auto refused = [](const std::vector<std::string>& more, const std::string& piece) {
    std::vector<std::string> arguments{BLADEFIT_COMMAND, "reproduce"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find(piece), std::string::npos) << outcome.output;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
  };
  refused({"--data", scratch("nothing")}, "nothing: has no arl_fan/case.json; give --data");
  refused({"--table", "17"}, "--table 17: there is no such table; give 1 to 16 or I to XVI");
  refused({"--table", "IIII"}, "--table IIII: there is no such table");
  std::filesystem::copy(BLADEFIT_TEST_DATA, scratch("data"), std::filesystem::copy_options::recursive);
  const std::string file = scratch("data") + "/arl_fan/case.json";
  std::ofstream(file) << "{\"units\": \"in\"";
  refused({"--data", scratch("data"), "--table", "I"}, "arl_fan/case.json: ");
  std::ofstream(file) << "{\"units\": \"in\"}";
  refused({"--data", scratch("data"), "--table", "I"}, "arl_fan/case.json: ");
}

}  // namespace
}  // namespace bladefit::testing
