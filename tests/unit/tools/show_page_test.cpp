// The page that shows a design holds its geometry and asks for nothing from outside; its lines are where they say.

#include <gtest/gtest.h>

#include <array>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/process.hpp"
#include "tests/support/reference_design.hpp"
#include "tools/batch/tip_radius.hpp"
#include "tools/show/base64.hpp"
#include "tools/show/design_page.hpp"

namespace bladefit {
namespace {

using hil::data_file;
using hil::Process;
using hil::ScratchFolder;
using Json = nlohmann::json;

std::string base64_of(const std::string& text) { return base64(std::as_bytes(std::span(text))); }

TEST(Base64, AsInRfc4648) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of("\xff\xfe\xfd"), "//79");
}

PageContent page_of(const Surface& surface) {
  PageContent content;
  content.title = "blade";
  content.tip_radius_mm = tip_radius_of(surface, content.axis);
  content.names.assign(surface.image().patches().size(), "FACE");
  ToleranceMap map;
  map.boxes[map.box_count++] = {0, 0.4, 0.6, 0, 1};
  fill_page(surface, map, content);
  return content;
}

/// By cells of the grid: a limit by radius is off by some of their width.
TEST(ShowPage, ZonesOfTheirOwnAreDrawnWhereTheyAre) {
  const Surface& surface = testing::reference_design("dtmb4119").surface();
  PageContent content;
  content.tip_radius_mm = tip_radius_of(surface, content.axis);
  content.names.assign(surface.image().patches().size(), "FACE");
  content.zone_names = {"tip edge", "outer blade"};
  ToleranceMap map;
  const double low = 0.7 * content.tip_radius_mm;
  map.boxes[map.box_count++] = {0, 0.4, 0.6, 0, 1, 1};
  map.zones[0] = {Region::leading_edge, false, low, 1e6, 0.1, 0.05};
  map.zones[1] = {Region::rest, true, low, 1e6, 0.3, 0.2};
  map.zone_count = 2;
  fill_page(surface, map, content);
  std::array<std::size_t, 2> parts{};
  for (const FaceMesh& part : content.zones) {
    ASSERT_TRUE(part.zone == 1 || part.zone == 2);
    ++parts.at(part.zone - 1);
    const bool edge = part.us.front() >= 0.4 && part.us.back() <= 0.6;
    const bool beside = part.us.back() <= 0.4 || part.us.front() >= 0.6;
    EXPECT_TRUE(part.zone == 1 ? edge : beside) << part.us.front() << " to " << part.us.back();
    for (const Vec3& point : part.points) EXPECT_GT(content.axis.radius_of(point), 0.96 * low);
  }
  EXPECT_GT(parts[0], 0U);
  EXPECT_GT(parts[1], 1U) << "on both sides of the edge";
  const std::string page = design_page(content);
  EXPECT_NE(page.find("\"zone_names\":[\"tip edge\",\"outer blade\"]"), std::string::npos);
}

TEST(ShowPage, LinesAreWhereTheySay) {
  const Surface& surface = testing::reference_design("dtmb4119").surface();
  const PageContent content = page_of(surface);
  ASSERT_EQ(content.faces.size(), 1U);
  ASSERT_EQ(content.zones.size(), 1U);
  EXPECT_EQ(content.zones[0].us.front(), 0.4);
  EXPECT_EQ(content.zones[0].us.back(), 0.6);
  int rings = 0, ridges = 0, labelled_u = 0;
  for (const PageLine& line : content.lines) {
    if (line.kind == LineKind::ridge) ++ridges;
    if (line.kind == LineKind::constant_u) labelled_u += line.label.starts_with("u 0.") ? 1 : 0;
    if (line.kind != LineKind::ring) continue;
    ++rings;
    const double radius = std::stod(line.label.substr(4)) * content.tip_radius_mm;
    for (const Vec3& end : line.ends) EXPECT_NEAR(content.axis.radius_of(end), radius, 0.1) << line.label;
  }
  EXPECT_EQ(rings, 7);  // r/R 0.3 to 0.9: the blade begins at 0.204
  EXPECT_EQ(ridges, 1);
  EXPECT_EQ(labelled_u, 9);
  ASSERT_EQ(content.notes.size(), 1U);
  EXPECT_NE(content.notes[0].find("patch 0 u 0.497"), std::string::npos) << content.notes[0];
}

TEST(ShowPage, MeshIsDenseWhereTheBladeBends) {
  const Surface& surface = testing::reference_design("dtmb4119").surface();
  const std::vector<double> us = mesh_parameters(surface, 0, true, 101);
  ASSERT_EQ(us.size(), 101U);
  EXPECT_EQ(us.front(), 0);
  EXPECT_EQ(us.back(), 1);
  int at_edge = 0;
  for (std::size_t k = 1; k < us.size(); ++k) {
    EXPECT_GT(us[k], us[k - 1]);
    at_edge += us[k] > 0.47 && us[k] < 0.53 ? 1 : 0;
  }
  EXPECT_GT(at_edge, 20);  // of 6 if they were even
}

/// What stands between two marks.
std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from) + from.size();
  return text.substr(begin, text.find(to, begin) - begin);
}

TEST(ShowPage, IsOneFileThatAsksForNothing) {
  PageContent content = page_of(testing::reference_design("arl_fan").surface());
  content.title = "a <b> & {{content}}";
  content.names = {"</script><script>alert(1)</script>"};
  content.points = {{7, Vec3(1, 2, 3), 0, 0.5, 0.25, -0.125, true}};
  const std::string page = design_page(content);
  EXPECT_NE(page.find("<title>a &lt;b&gt; &amp; {{content}}</title>"), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  for (const char* outside : {"http:", "https:", "src=", "href=", "url(", "import "}) {
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  }
  EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
  const Json json = Json::parse(between(page, "id=\"content\">", "</script>"));
  EXPECT_EQ(json.at("names").at(0), "</script><script>alert(1)</script>");
  EXPECT_EQ(json.at("units"), "mm");
  EXPECT_EQ(json.at("points").at("numbers"), base64_of(std::string("\x07\0\0\0", 4)));
  EXPECT_EQ(json.at("points").at("zones"), base64_of("\x01"));
  const std::size_t numbers = 3 * content.faces[0].us.size() * content.faces[0].vs.size();
  EXPECT_EQ(json.at("faces").at(0).at("places").get<std::string>().size(), (4 * numbers + 2) / 3 * 4);
}

TEST(ShowCommand, WritesThePageAndRefusesInOneLine) {
  const ScratchFolder folder;
  const std::string design = data_file("dtmb4119/design.igs"), out = folder / "page.html";
  Process done({BLADEFIT_COMMAND, "show", design, "-o", out, "--points", data_file("dtmb4119/subsets/050.csv"),
                "--leading-edge", "auto:5mm"});
  ASSERT_EQ(done.exit_code(), 0) << done.err();
  EXPECT_NE(done.out().find("its zone: 5 mm along the sections on either side"), std::string::npos) << done.out();
  const Json json = Json::parse(between(hil::read_whole(out), "id=\"content\">", "</script>"));
  EXPECT_EQ(json.at("names").at(0), "PATCH1");
  EXPECT_GT(json.at("zones").size(), 3U);

  const std::vector<std::vector<std::string>> wrong = {{"show", design, "-o", design},
                                                       {"show", folder / "none.igs", "-o", out},
                                                       {"show", design, "-o", out, "--leading-edge", "auto:5"},
                                                       {"show", design, "-o", out, "--leading-edge-near", "1,2"},
                                                       {"show", design, "-o", out, "--points", folder / "none.csv"}};
  for (const std::vector<std::string>& arguments : wrong) {
    Process refused(hil::operator+({BLADEFIT_COMMAND}, arguments));
    EXPECT_EQ(refused.exit_code(), 2) << arguments.back();
    const std::string told = refused.err();
    EXPECT_EQ(told.find('\n'), told.size() - 1) << told;
  }
}

}  // namespace
}  // namespace bladefit
