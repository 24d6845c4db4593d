#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <stack>

#include "tests/unit/tools/report_session.hpp"

namespace bladefit {
namespace {

using testing::SessionFolder;
using testing::SessionPoint;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

/// Tags that are opened and closed wrongly; empty = well nested.
std::string nesting_fault(const std::string& page) {
  std::stack<std::string> open;
  for (std::size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at + 1)) {
    const std::size_t end = page.find('>', at);
    if (end == std::string::npos) return "a tag without an end";
    const std::string tag = page.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(0, tag.find_first_of(" \n/", 1));
    if (name == "!DOCTYPE" || name == "meta" || tag.back() == '/') continue;
    if (name[0] != '/') {
      open.push(name);
    } else if (open.empty() || "/" + open.top() != name) {
      return name + " where " + (open.empty() ? "nothing" : open.top()) + " is open";
    } else {
      open.pop();
    }
  }
  return open.empty() ? "" : open.top() + " is never closed";
}

TEST(ReportFormats, JsonIsTheResultToTheLetter) {
  const SessionFolder session;
  ASSERT_EQ(session.report(". --format json -o copy.json"), 0) << session.read("out.txt");
  EXPECT_EQ(session.read("copy.json"), session.read("result.json"));
}

TEST(ReportFormats, CsvHasALineAPointInTheUnitOfTheResult) {
  const SessionFolder session;
  ASSERT_EQ(session.report(". --format csv -o points.csv"), 0) << session.read("out.txt");
  std::istringstream text(session.read("points.csv"));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line,
            "sequence,x_in,y_in,z_in,patch,u,v,kind,region,distance_in,tolerance_in,uncertainty_in,state,action,"
            "expanded_uncertainty_in,distance_before_in,side,radius_in,r_over_R,chord_percent");
  std::getline(text, line);
  EXPECT_EQ(line, "1,1,-2,0.1,0,0.5,0.1,interior,leading_edge,0.02,0.01,0.0005,out,cut,0.001,0.05,,,,");
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(text), {}, '\n'), 4);
}

TEST(ReportFormats, CsvLeavesAToleranceThatWasNotSetEmpty) {
  const SessionFolder session;
  session.write("verdicts.csv", testing::replaced(session.read("verdicts.csv"), ",0.254,", ",inf,"));
  ASSERT_EQ(session.report(". --format csv -o points.csv"), 0) << session.read("out.txt");
  EXPECT_TRUE(contains(session.read("points.csv"), "leading_edge,0.02,,0.0005,out,cut"));
}

TEST(ReportFormats, PageSaysWhatIsOutAndWhatToDo) {
  const std::string page = SessionFolder().page();
  for (const char* part : {"Out of tolerance: 2 points, 2 at the leading edge, 0 on the rest of the blade",
                           "5 points measured; 1 does not count",
                           "tolerance ±0.01000 in; 2 are out: 1 to cut, 1 to weld. Worst: +0.02000 in, cut; point 1",
                           "1 of them not decided", "+ cut</b>", "&minus; weld</b>", "least squares", "1234abcd"}) {
    EXPECT_TRUE(contains(page, part)) << part;
  }
  EXPECT_EQ(nesting_fault(page), "");
}

TEST(ReportFormats, PageNeedsNothingFromElsewhere) {
  const std::string page = SessionFolder().page();
  for (const char* part : {"<script", "<link", "<img", "src=", "href=", "url(", "http", "@import"})
    EXPECT_FALSE(contains(page, part)) << part;
}

TEST(ReportFormats, MapCanBeReadWithoutColour) {
  const std::string page = SessionFolder().page();
  EXPECT_EQ(count_of(page, "class=\"number\""), 4U) << "two points on two maps";
  EXPECT_EQ(count_of(page, ">Patch 0<"), 2U);
  EXPECT_TRUE(contains(page, "Leading edge, magnified"));
  EXPECT_EQ(count_of(page, "class=\"out\""), 6U) << "two points on two maps, two entries of the legend";
  EXPECT_TRUE(contains(page, "class=\"edge\""));
  EXPECT_TRUE(contains(page, "distance, in"));
  EXPECT_TRUE(contains(page, "Histogram of distances"));
}

TEST(ReportFormats, NamesOfTheSessionCannotBecomeMarkup) {
  const SessionFolder session;
  const std::string name = "a <script>&'";
  const std::filesystem::path inner = session.path() / name;
  std::filesystem::create_directory(inner);
  for (const char* file : {"result.json", "verdicts.csv", "journal.bin"})
    std::filesystem::copy_file(session.path() / file, inner / file);
  const std::string result = session.read("result.json");
  testing::SessionFolder::write_file(inner / "result.json", testing::replaced(result, "converged", "<b>converged"));
  ASSERT_EQ(session.report("\"" + name + "\" --format html -o page.html"), 0) << session.read("out.txt");
  const std::string page = session.read("page.html");
  EXPECT_FALSE(contains(page, "<script"));
  EXPECT_TRUE(contains(page, "a &lt;script&gt;&amp;&#39;"));
  EXPECT_TRUE(contains(page, "&lt;b&gt;converged"));
}

TEST(ReportFormats, HeadlineFollowsTheVerdict) {
  const std::vector<SessionPoint> good = {{1, "rest", 0.01, "in", "none"}};
  const SessionFolder session(good);
  EXPECT_TRUE(contains(session.page(), "In tolerance: every point is within its tolerance"));
  session.judge(testing::verdict_of_blade("not_judged"));
  EXPECT_TRUE(contains(session.page(), "Not judged: no tolerance was set"));
  session.judge(
      testing::verdict_of_blade("not_decided", "points_lost", "points 3 to 7 never arrived; probe them again"));
  EXPECT_TRUE(contains(session.page(), "Not decided: points 3 to 7 never arrived"));
  session.judge(testing::verdict_of_blade("out_of_tolerance"));
  EXPECT_TRUE(contains(session.page(), "Out of tolerance: no pose brings all points within their tolerances"));
}

TEST(ReportFormats, UndecidedPointsAreCountedWhereTheyLie) {
  const std::vector<SessionPoint> points = {{1, "rest", 0.01, "in", "none"},
                                            {2, "leading_edge", 0.0099, "undecided", "none"}};
  const std::string page = SessionFolder(points).page();
  EXPECT_TRUE(contains(page, "none is out. 1 point undecided.")) << page.substr(page.find("Leading edge: "), 200);
  const std::string row = page.substr(page.find("<tr><td>Leading edge</td>"));
  EXPECT_TRUE(contains(row.substr(0, row.find("</tr>")), "<td>0</td><td>0</td><td>1</td>")) << row.substr(0, 300);
}

TEST(ReportFormats, SessionsOfOnePointAndOfManyPatchesAreDrawn) {
  const std::vector<SessionPoint> one = {{1, "rest", 0.0, "in", "none"}};
  EXPECT_EQ(nesting_fault(SessionFolder(one).page()), "");
  const SessionFolder patches;
  std::string verdicts = patches.read("verdicts.csv");
  verdicts = testing::replaced(verdicts, "\n2,0,", "\n2,7,");
  verdicts = testing::replaced(verdicts, "\n4,0,", "\n4,4294967295,");
  patches.write("verdicts.csv", verdicts);
  const std::string page = patches.page();
  EXPECT_EQ(nesting_fault(page), "");
  for (const char* part : {">Patch 0<", ">Patch 7<", ">Patch 4294967295<"}) EXPECT_TRUE(contains(page, part)) << part;
}

TEST(ReportFormats, AStrayTouchDoesNotHideTheOthers) {
  std::vector<SessionPoint> points;
  for (std::uint32_t k = 1; k <= 50; ++k) points.push_back({k, "rest", 0.001 * k, "in", "none"});
  points.push_back({51, "rest", 2540.0, "out", "cut"});
  EXPECT_TRUE(contains(SessionFolder(points).page(), "1 farther away"));
}

}  // namespace
}  // namespace bladefit
