#include <gtest/gtest.h>

#include <functional>

#include "tools/design/loft/loft.hpp"
#include "tools/design/loft/sections_csv.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

TEST(SectionsCsv, ReadsSectionsOfAnyNameAndLength) {
  const BladeSections sections = parse_sections_csv(
      "\xEF\xBB\xBF# a comment\n z , "
      "section,y,x,r_over_R,index\r\n3,root,2,1,0.3,0\n6,root,5,4,0.3,2\n\n9,tip,8,7,1,0\n",
      "s.csv");
  ASSERT_EQ(sections.sections.size(), 2U);
  EXPECT_EQ(sections.sections[0].name, "root");
  EXPECT_EQ(sections.sections[0].radius, 0.3);
  EXPECT_EQ(sections.sections[0].points.at(1), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(sections.sections[0].lines, (std::vector<std::size_t>{3, 4}));
  EXPECT_EQ(sections.sections[1].points.at(0), Eigen::Vector3d(7, 8, 9));
}

TEST(SectionsCsv, ReadsTheReferenceFile) {
  const BladeSections sections = read_sections_csv(BLADEFIT_TEST_DATA "/pnsy_sub/sections.csv");
  ASSERT_EQ(sections.sections.size(), 17U);
  for (const BladeSection& section : sections.sections) EXPECT_EQ(section.points.size(), 180U);
  EXPECT_EQ(default_control_points(sections, 3), 56);
}

struct BadSections {
  std::string text, wanted;
};

class SectionsRefused : public ::testing::TestWithParam<BadSections> {};

std::string refusal_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const ToolError& error) {
    EXPECT_EQ(error.exit_code(), 2);
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  return "accepted";
}

TEST_P(SectionsRefused, InOneLineThatNamesThePlace) {
  const std::string message = refusal_of([] { parse_sections_csv(GetParam().text, "s.csv"); });
  EXPECT_NE(message.find(GetParam().wanted), std::string::npos) << message;
  EXPECT_EQ(message.rfind("s.csv", 0), 0U) << message;
}

INSTANTIATE_TEST_SUITE_P(
    All, SectionsRefused,
    ::testing::Values(BadSections{"", "the file is empty"}, BadSections{"section,x,y,z\n", "no point in the file"},
                      BadSections{"x,y,z\n", "s.csv:1: column 'section' is missing"},
                      BadSections{"section,x,y,w\n", "s.csv:1: column 'z' is missing among 'section', 'x', 'y', 'w'"},
                      BadSections{"0,1,2,3\n", "a number, '0'"}, BadSections{"section,x,y,z,x\n", "named twice"},
                      BadSections{"section,x,y,z\n0,1,2\n", "s.csv:2: 3 columns where 4 are named"},
                      BadSections{"section,x,y,z\n0,1,two,3\n", "s.csv:2: column y: 'two'"},
                      BadSections{"section,x,y,z\n0,1,nan,3\n", "column y: 'nan'"},
                      BadSections{"section,x,y,z\n,1,2,3\n", "s.csv:2: column section: it is empty"},
                      BadSections{"section,x,y,z\n0,1,2,3\n1,1,2,3\n0,1,2,4\n", "s.csv:4: section 0 goes on"},
                      BadSections{"section,index,x,y,z\n0,1,1,2,3\n0,1,1,2,4\n", "s.csv:3: column index: 1 after 1"},
                      BadSections{"section,r_over_R,x,y,z\n0,0.2,1,2,3\n0,0.3,1,2,4\n", "s.csv:3: column r_over_R"},
                      BadSections{std::string("section,x,y,z\n\0", 15), "s.csv:2: a control character"}));

/// `sections` straight sections of `points` points.
BladeSections ladder(int sections, int points) {
  std::string text = "section,x,y,z\n";
  for (int s = 0; s < sections; ++s) {
    for (int k = 0; k < points; ++k)
      text += std::to_string(s) + "," + std::to_string(k) + ",0," + std::to_string(s) + "\n";
  }
  return parse_sections_csv(text, "s.csv");
}

TEST(LoftRefuses, WhatDoesNotDetermineASurface) {
  const auto expect = [](const BladeSections& sections, const LoftSettings& settings, const std::string& wanted) {
    const std::string message = refusal_of([&] { (void)loft(sections, settings, 1); });
    EXPECT_NE(message.find(wanted), std::string::npos) << message;
  };
  expect(ladder(3, 12), {}, "s.csv: 3 sections are too few for degree 3");
  expect(ladder(4, 3), {}, "s.csv:4: section 0 has 3 points, too few for 4 control points");
  expect(ladder(4, 12), {.control_points = 13}, "section 0 has 12 points, too few for 13 control points");
  expect(ladder(4, 12), {.control_points = 2000000000}, "too few for 2000000000 control points");
  expect(ladder(4, 12), {.control_points = 3}, "--control-points 3: a curve of degree 3 has at least 4");
  expect(ladder(4, 12), {.degree = 0}, "--degree 0");
  expect(ladder(4, 12), {.span_degree = 10}, "--span-degree 10");
  expect(ladder(4, 12), {.control_points = 8, .knots = {0.5}}, "not both");
  for (const double knot : {0.0, 1.0, 0.3, -1.0}) expect(ladder(4, 12), {.knots = {0.4, knot}}, "--knots");
  expect(ladder(4, 12), {.knots = {0.5, 0.51, 0.52, 0.53, 0.54}}, "no points between some knots");
  BladeSections same = ladder(4, 12);
  for (Eigen::Vector3d& point : same.sections[2].points) point.setZero();
  expect(same, {}, "s.csv:26: all points of section 2 are the same");
}

}  // namespace
}  // namespace bladefit
