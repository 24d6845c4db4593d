#include <gtest/gtest.h>

#include <clocale>
#include <cstdio>
#include <string>

#include "drivers/replay/points_csv.hpp"

namespace bladefit {
namespace {

TEST(PointsCsv, ReadsEveryColumnInAnyOrder) {
  const PointsFile file = parse_points_csv("path,z,y,x,k,j,i\r\n# a comment\r\n\r\n7,3,2,+1,1,0,0\r\n", "a.csv", {});
  ASSERT_EQ(file.error.message, "");
  ASSERT_EQ(file.points.size(), 1U);
  EXPECT_EQ(file.points[0].position, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(file.points[0].approach, (std::array<double, 3>{0, 0, 1}));
  EXPECT_EQ(file.points[0].path, 7);
  EXPECT_EQ(file.points[0].sequence, 1U);
  EXPECT_TRUE(file.has_approach);
  EXPECT_TRUE(file.has_path);
}

TEST(PointsCsv, TakesEveryKindOfLineEnd) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const PointsFile file = parse_points_csv("x,y,z" + end + end + "1,2,3" + end + "4,5,6", "a.csv", {});
    ASSERT_EQ(file.error.message, "");
    EXPECT_EQ(file.points.size(), 2U);
    EXPECT_EQ(parse_points_csv("x,y,z" + end + end + "1,2,q", "a.csv", {}).error.message.substr(0, 8), "a.csv:3:");
  }
}

TEST(PointsCsv, ScalesLengthsAndNotDirections) {
  const PointsFile file = parse_points_csv("x,y,z,i,j,k\n1,-2,3e1,0.6,0.8,0\n", "a.csv", {.unit = Unit::inch});
  ASSERT_EQ(file.error.message, "");
  EXPECT_EQ(file.points[0].position, (std::array<double, 3>{25.4, -50.8, 30 * 25.4}));
  EXPECT_NEAR(file.points[0].approach[1], 0.8, 1e-15);
  EXPECT_FALSE(file.has_path);
}

TEST(PointsCsv, NormalisesDirectionsAndKeepsUnknownOnes) {
  const PointsFile file = parse_points_csv("x,y,z,i,j,k\n1,2,3,0.9995,0,0\n1,2,3,0,0,0", "a.csv", {});
  ASSERT_EQ(file.error.message, "");
  EXPECT_EQ(file.points[0].approach[0], 1.0);
  EXPECT_EQ(file.points[1].approach, (std::array<double, 3>{}));
}

struct BadFile {
  std::string text;
  std::string error;  ///< must be part of the message
};

class PointsCsvErrors : public ::testing::TestWithParam<BadFile> {};

TEST_P(PointsCsvErrors, NameFileLineColumnAndFix) {
  const PointsFile file = parse_points_csv(GetParam().text, "a.csv", {});
  EXPECT_TRUE(file.points.empty());
  EXPECT_NE(file.error.message.find(GetParam().error), std::string::npos) << file.error.message;
  EXPECT_TRUE(file.error.message.starts_with("a.csv")) << file.error.message;
  EXPECT_EQ(file.error.message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    All, PointsCsvErrors,
    ::testing::Values(
        BadFile{"", "empty"}, BadFile{"# only\n", "empty"}, BadFile{"x,y,z\n", "list of points is empty"},
        BadFile{"1,2,3\n", "a.csv:1: a number"}, BadFile{"x,y,q\n", "column 'z' is missing among 'x', 'y', 'q'"},
        BadFile{"x,y\n1,2\n", "column 'z' is missing"}, BadFile{"x,y,z,i\n1,2,3,4\n", "column 'j' is missing"},
        BadFile{"x,y,z,x\n", "named twice"}, BadFile{"x,y,z\n1,2,abc\n", "a.csv:2: column z: 'abc'"},
        BadFile{"x,y,z\n1,2,\n", "column z: it is empty"}, BadFile{"x,y,z\n\n1,nan,3\n", "a.csv:3: column y: 'nan'"},
        BadFile{"x,y,z\ninf,2,3\n", "column x: 'inf'"}, BadFile{"x,y,z\n1e999,2,3\n", "column x"},
        BadFile{"x,y,z\n1,2\n", "a.csv:2: 2 columns"}, BadFile{"x,y,z\n1,2,3,4\n", "4 columns"},
        BadFile{"x,y,z,path\n1,2,3,70000\n", "column path"}, BadFile{"x,y,z,path\n1,2,3,-1\n", "column path"},
        BadFile{"x,y,z\n1 2,2,3\n", "column x: '1 2'"}, BadFile{"x,y,z,i,j,k\n1,2,3,0.5,0,0\n", "length 0.5"},
        BadFile{"x,y,z\n1,2,+-3\n", "column z"},
        BadFile{std::string("x,y,z\n1,2,3\n\0\1\2", 15), "a.csv:3: a control character"},
        BadFile{"\x7f"
                "ELF",
                "a.csv:1: column 'x' is missing among '?ELF'"}));

TEST(PointsCsv, IgnoresTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(parse_points_csv("x,y,z\n1.5,2,3\n", "a.csv", {}).points[0].position[0], 1.5);
  std::setlocale(LC_ALL, before.c_str());
}

TEST(PointsCsv, ReadsReferenceFiles) {
  const PointsFile file = read_points_csv(BLADEFIT_TEST_DATA "/dtmb4119/points.csv", {});
  ASSERT_EQ(file.error.message, "");
  EXPECT_EQ(file.points.size(), 2000U);
  EXPECT_EQ(file.points.back().sequence, 2000U);
}

TEST(PointsCsv, NamesAFileThatCannotBeRead) {
  EXPECT_NE(
      read_points_csv("/nonexistent/a.csv", {}).error.message.find("/nonexistent/a.csv: no such file; check the name"),
      std::string::npos);
  EXPECT_NE(read_points_csv("/tmp", {}).error.message.find("/tmp: is a folder; name a file in it"), std::string::npos);
}

}  // namespace
}  // namespace bladefit
