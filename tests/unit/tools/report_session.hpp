#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_bridge/host/journal/journal.hpp"
#include "firmware_bridge/host/journal/journal_reader.hpp"
#include "tests/unit/tools/design_fixtures.hpp"

/// Session folders as `bladefit run` leaves them, made by hand.
namespace bladefit::testing {

struct SessionPoint {
  std::uint32_t sequence;
  const char* region;
  double distance_mm;
  const char* state;
  const char* action;
};

/// Five points of a blade in inches: one to cut, one to weld, one that does not count, one undecided.
inline std::vector<SessionPoint> some_points() {
  return {{1, "leading_edge", 0.508, "out", "cut"},
          {2, "leading_edge", -0.381, "out", "weld"},
          {4, "rest", 0.0254, "in", "none"},
          {5, "rest", 0.1, "rejected", "none"},
          {7, "rest", -0.05, "pending", "none"}};
}

inline nlohmann::json verdict_of_blade(const char* state, const char* code = "", const char* text = "") {
  nlohmann::json reasons = nlohmann::json::array();
  if (*code != '\0') reasons.push_back({{"code", code}, {"text", text}});
  return {{"state", state},
          {"reasons", reasons},
          {"lost", nlohmann::json::array()},
          {"decision", "simple"},
          {"coverage_factor", 2.0}};
}

/// Out of tolerance where a point is out, else in tolerance.
inline nlohmann::json result_of_points(const std::vector<SessionPoint>& points) {
  const auto out = [](const SessionPoint& point) { return std::string_view(point.state) == "out"; };
  nlohmann::json list = nlohmann::json::array();
  for (const SessionPoint& point : points) {
    list.push_back({{"index", point.sequence - 1}, {"state", point.state}, {"distance", point.distance_mm / 25.4}});
  }
  const nlohmann::json sums = {
      {"count", 2}, {"rms_before", 0.03}, {"rms_after", 0.02}, {"max_abs_after", 0.02}, {"tolerance", 0.01}};
  nlohmann::json result = {
      {"status", "converged"}, {"mode", "least_squares"}, {"units", "in"}, {"covariance", nullptr}};
  result["pose"] = {{"rotation", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                    {"translation", {0.1, 0.2, 0.3}},
                    {"euler", {{"psi", 0}, {"theta", 0}, {"phi", 0}}}};
  result["summary"] = {
      {"count", 4}, {"rms_before", 0.03}, {"rms_after", 0.02}, {"max_abs_before", 0.05}, {"max_abs_after", 0.02}};
  result["regions"] = {{"leading_edge", sums}, {"rest", sums}};
  result["regions"]["leading_edge"]["boxes"] = {{{"patch", 0}, {"u", {0.4, 0.6}}, {"v", {0.0, 1.0}}}};
  result["points"] = list;
  result["verdict"] = verdict_of_blade(std::ranges::any_of(points, out) ? "out_of_tolerance" : "in_tolerance");
  return result;
}

inline std::string verdicts_of_points(const std::vector<SessionPoint>& points) {
  std::string text =
      "sequence,patch,u,v,kind,region,distance_mm,tolerance_mm,uncertainty_mm,state,action,x,y,z,"
      "expanded_uncertainty_mm,distance_before_mm,left_out,beyond_mm\n";
  for (const SessionPoint& point : points) {
    text += std::to_string(point.sequence) + ",0,0.5,0." + std::to_string(point.sequence) + ",interior," +
            point.region + "," + std::to_string(point.distance_mm) + ",0.254,0.0127," + point.state + "," +
            point.action + ",25.4,-50.8,2.54,0.0254,1.27," +
            (std::string_view(point.state) == "rejected" ? "edge" : "none") + ",0\n";
  }
  return text;
}

inline StreamEvent event_of_sequence(std::uint32_t sequence, double x = 25.4) {
  StreamEvent event;
  event.point.sequence = sequence;
  event.point.position = {x, -50.8, 2.54};
  return event;
}

/// A folder with a recording and, unless a test spoils them, the files of its result.
class SessionFolder {
 public:
  explicit SessionFolder(const std::vector<SessionPoint>& points = some_points()) {
    write("result.json", result_of_points(points).dump(1) + "\n");
    write("verdicts.csv", verdicts_of_points(points));
    std::vector<StreamEvent> events;
    for (const SessionPoint& point : points) events.push_back(event_of_sequence(point.sequence));
    record(events);
  }

  static void write_file(const std::filesystem::path& path, const std::string& content) {
    std::ofstream(path, std::ios::binary) << content;
  }
  void write(const std::string& name, const std::string& content) const { write_file(folder_.path() / name, content); }
  [[nodiscard]] std::string read(const std::string& name) const { return read_whole(folder_.path() / name); }
  [[nodiscard]] std::filesystem::path path() const { return folder_.path(); }
  void remove(const std::string& name) const { std::filesystem::remove(folder_.path() / name); }

  void record(const std::vector<StreamEvent>& events) const {
    remove("journal.bin");
    Journal journal;
    ASSERT_FALSE(journal.open((folder_.path() / "journal.bin").string()));
    ASSERT_FALSE(journal.start({0x1234abcdU, 0x5678U}, 1));
    ASSERT_FALSE(journal.append(events));
  }

  /// Runs `bladefit report ARGUMENTS` in the folder; what it says is in out.txt. Returns the exit code.
  [[nodiscard]] int report(const std::string& arguments) const {
    const std::string command =
        "cd '" + folder_.path().string() + "' && '" BLADEFIT_COMMAND "' report " + arguments + " > out.txt 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// Puts another verdict into result.json.
  void judge(const nlohmann::json& verdict) const {
    nlohmann::json result = nlohmann::json::parse(read("result.json"));
    result["verdict"] = verdict;
    write("result.json", result.dump(1) + "\n");
  }

  /// The page of the session; a failure where there is none.
  [[nodiscard]] std::string page() const {
    EXPECT_EQ(report(". --format html -o page.html"), 0) << read("out.txt");
    return read("page.html");
  }

 private:
  ScratchFolder folder_;
};

/// That `report` refuses the folder in one line with these parts, and leaves no output behind.
inline void expect_refused(const SessionFolder& session, const std::vector<std::string>& parts,
                           const std::string& arguments = ". --format csv -o report.out") {
  EXPECT_EQ(session.report(arguments), 2);
  const std::string said = session.read("out.txt");
  for (const std::string& part : parts) EXPECT_NE(said.find(part), std::string::npos) << part << " in\n" << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  for (const auto& entry : std::filesystem::directory_iterator(session.path()))
    EXPECT_EQ(entry.path().filename().string().find("report.out"), std::string::npos);
}

}  // namespace bladefit::testing
