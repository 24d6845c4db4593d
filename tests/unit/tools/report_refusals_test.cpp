#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/unit/tools/report_session.hpp"

namespace bladefit {
namespace {

using testing::event_of_sequence;
using testing::expect_refused;
using testing::SessionFolder;

TEST(ReportRefusals, FormatsThatAreNotThere) {
  for (const char* format : {"dmo", "docx", "HTML", "''"}) {
    expect_refused(SessionFolder(), {"html, pdf, csv, json and qif"},
                   ". --format " + std::string(format) + " -o report.out");
  }
}

TEST(ReportRefusals, MissingArguments) {
  expect_refused(SessionFolder(), {"--format"}, ". -o report.out");
  expect_refused(SessionFolder(), {"--output"}, ". --format csv");
}

TEST(ReportRefusals, FoldersThatAreNoSession) {
  expect_refused(SessionFolder(), {"nowhere", "there is no such folder"}, "nowhere --format csv -o report.out");
  expect_refused(SessionFolder(), {"result.json", "is not a folder"}, "result.json --format csv -o report.out");
  const SessionFolder empty;
  empty.remove("journal.bin");
  expect_refused(empty, {"holds no journal.bin", "bladefit run --session"});
}

TEST(ReportRefusals, SessionThatStillRunsOrWasCutOff) {
  const SessionFolder running;
  running.remove("result.json");
  expect_refused(running, {"result.json", "still runs or was cut off (5 points", "again with the same --session"});
}

TEST(ReportRefusals, ResultThatIsOlderThanTheRecording) {
  const SessionFolder resumed;
  resumed.record({event_of_sequence(1), event_of_sequence(7), event_of_sequence(9)});
  expect_refused(resumed, {"ends with point 7, the recording with point 9", "again with the same --session"});
  StreamEvent reset;
  reset.kind = EventKind::reset;
  resumed.record({event_of_sequence(7), reset});
  expect_refused(resumed, {"the recording with point 0"});
}

TEST(ReportRefusals, ARecordThatTheLocalizerRefusedIsNoNewerPoint) {
  const SessionFolder session;
  StreamEvent finished;
  finished.kind = EventKind::finished;
  session.record({event_of_sequence(7), event_of_sequence(8, std::numeric_limits<double>::quiet_NaN()), finished});
  EXPECT_EQ(session.report(". --format csv -o points.csv"), 0) << session.read("out.txt");
}

TEST(ReportRefusals, FilesOfDifferentRuns) {
  const SessionFolder other_state;
  other_state.write("verdicts.csv", testing::replaced(other_state.read("verdicts.csv"), "in,none", "pending,none"));
  expect_refused(other_state, {"result.json (5 points)", "verdicts.csv (5 points)", "not of one run"});
  const SessionFolder fewer;
  std::string verdicts = fewer.read("verdicts.csv");
  verdicts.erase(verdicts.rfind("\n7,") + 1);
  fewer.write("verdicts.csv", verdicts);
  expect_refused(fewer, {"verdicts.csv (4 points)", "not of one run"});
}

TEST(ReportRefusals, DamagedJournal) {
  const SessionFolder session;
  std::string bytes = session.read("journal.bin");
  bytes[9] = 'x';
  session.write("journal.bin", bytes);
  expect_refused(session, {"journal.bin"});
}

struct Damage {
  std::string from, to;
  std::vector<std::string> said;
};

TEST(ReportRefusals, DamagedResult) {
  const std::vector<Damage> table = {
      {"\"mode\": \"least_squares\",", "", {"field mode is missing"}},
      {"\"units\": \"in\"", "\"units\": \"ft\"", {"field units", "'ft'", "mm, in, cm, m belongs"}},
      {"\"tolerance\": 0.01", "\"tolerance\": \"x\"", {"field regions.leading_edge.tolerance is not a number"}},
      {"\"patch\": 0", "\"patch\": -1", {"field regions.leading_edge.boxes[0].patch is not a whole number"}},
      {"\"covariance\": null", "\"covariance\": [1]", {"field covariance has 1 elements where 6 belong"}},
      {"\"state\": \"out\"", "\"state\": \"lost\"", {"field points[0].state is none of the words"}},
      {"\"translation\": [", "\"translation\": [[],", {"field pose.translation has 4 elements where 3 belong"}},
  };
  for (const Damage& damage : table) {
    const SessionFolder session;
    const std::string result = session.read("result.json");
    ASSERT_NE(result.find(damage.from), std::string::npos) << damage.from;
    session.write("result.json", testing::replaced(result, damage.from, damage.to));
    std::vector<std::string> said = damage.said;
    said.emplace_back("result.json");
    said.emplace_back("same --session");
    expect_refused(session, said);
  }
}

TEST(ReportRefusals, ResultThatIsNoJson) {
  const SessionFolder session;
  const std::string result = session.read("result.json");
  for (const std::string& text : {std::string(), result.substr(0, result.size() / 2), std::string("PK\3\4\n"),
                                  "[" + result, std::string("7"), std::string(100000, '[')}) {
    session.write("result.json", text);
    expect_refused(session, {"result.json"});
  }
}

TEST(ReportRefusals, DamagedVerdicts) {
  const std::vector<Damage> table = {
      {"sequence,patch", "patch,sequence", {":1:", "not the columns"}},
      {"25.4,-50.8", "nan,-50.8", {":2:", "column x", "not a finite number"}},
      {"out,cut", "out,paint", {":2:", "column action: 'paint'"}},
      {"\n2,0,0.5", "\n2,0,1.5", {":3:", "column u: '1.5' is not within 0 to 1"}},
      {"\n4,", "\n1,", {":4:", "the sequence does not rise"}},
      {",none,0\n", ",none\n", {":2:", "17 columns where 18 belong"}},
      {"0.254", "-0.254", {":2:", "column tolerance_mm", "negative"}},
  };
  for (const Damage& damage : table) {
    const SessionFolder session;
    session.write("verdicts.csv", testing::replaced(session.read("verdicts.csv"), damage.from, damage.to));
    expect_refused(session, damage.said);
  }
  const SessionFolder torn;
  const std::string verdicts = torn.read("verdicts.csv");
  torn.write("verdicts.csv", verdicts.substr(0, verdicts.size() - 1));
  expect_refused(torn, {":6:", "no end"});
  torn.write("verdicts.csv", "");
  expect_refused(torn, {":1:"});
}

TEST(ReportRefusals, OutputsThatWouldHarm) {
  const SessionFolder session;
  const std::string result = session.read("result.json");
  for (const char* name : {"result.json", "journal.bin", "verdicts.csv"})
    expect_refused(session, {"would overwrite the session"}, std::string(". --format html -o ") + name);
  EXPECT_EQ(session.read("result.json"), result);
  EXPECT_EQ(session.report(". --format csv -o nowhere/points.csv"), 3);
  EXPECT_NE(session.read("out.txt").find("nowhere/points.csv"), std::string::npos);
}

}  // namespace
}  // namespace bladefit
