// Points files as measuring programs and spreadsheets write them: the same points, or a refusal with the place and the
// way out.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "drivers/replay/points_csv.hpp"

namespace bladefit {
namespace {

struct Dialect {
  std::string name, text;
};

void PrintTo(const Dialect& dialect, std::ostream* stream) { *stream << dialect.name; }

class PointsDialects : public ::testing::TestWithParam<Dialect> {};

/// All of them hold the points 1.5,-2,3.25 and 40,5.0625,-0.6 mm.
TEST_P(PointsDialects, HoldTheSamePoints) {
  const PointsFile file = parse_points_csv(GetParam().text, "a.csv", {});
  ASSERT_EQ(file.error.message, "");
  ASSERT_EQ(file.points.size(), 2U);
  EXPECT_EQ(file.points[0].position, (std::array<double, 3>{1.5, -2, 3.25}));
  EXPECT_EQ(file.points[1].position, (std::array<double, 3>{40, 5.0625, -0.6}));
}

INSTANTIATE_TEST_SUITE_P(
    All, PointsDialects,
    ::testing::Values(
        Dialect{"capitals", "X,Y,Z\n1.5,-2,3.25\n40,5.0625,-0.6\n"},
        Dialect{"blanks beside commas", " x , y , z \n 1.5 , -2 , 3.25\n40,  5.0625, -0.6 \n"},
        Dialect{"tabs", "x\ty\tz\n1.5\t-2\t3.25\n40\t5.0625\t-0.6\n"},
        Dialect{"tabs with an empty first cell", "Label\tx\ty\tz\n\t1.5\t-2\t3.25\nb\t40\t5.0625\t-0.6\n"},
        Dialect{"aligned by blanks", "     x      y     z\n   1.5     -2  3.25\n    40 5.0625  -0.6\n"},
        Dialect{"blanks before units", "X [mm]  Y [mm]  Z [mm]\n1.5 -2 3.25\n40 5.0625 -0.6\n"},
        Dialect{"semicolons with decimal points", "x;y;z\n1.5;-2;3.25\n40;5.0625;-0.6\n"},
        Dialect{"semicolons with decimal commas", "X;Y;Z\r\n1,5;-2;3,25\r\n40;5,0625;-0,6\r\n"},
        Dialect{"tabs with decimal commas", "X\tY\tZ\n1,5\t-2\t3,25\n40\t5,0625\t-0,6\n"},
        Dialect{"blanks with decimal commas", "X Y Z\n1,5 -2 3,25\n40 5,0625 -0,6\n"},
        Dialect{"decimal commas in quotation marks",
                "\"X\",\"Y\",\"Z\"\n\"1,5\",\"-2\",\"3,25\"\n40,\"5,0625\",\"-0,6\"\n"},
        Dialect{"bars", "x|y|z\n1.5|-2|3.25\n40|5.0625|-0.6\n"},
        Dialect{"quotation marks", "\"x\",\"y\",\"z\"\n\"1.5\",\"-2\",\"3.25\"\n\" 40 \",\"5.0625\",\"-0.6\"\n"},
        Dialect{"trailing commas", "x,y,z,\n1.5,-2,3.25,\n40,5.0625,-0.6,\n"},
        Dialect{"trailing commas of the rows only", "x,y,z\n1.5,-2,3.25,,\n40,5.0625,-0.6,\n"},
        Dialect{"trailing comma of the names only", "x,y,z,\n1.5,-2,3.25\n40,5.0625,-0.6\n"},
        Dialect{"labels", "Point,X,Y,Z,Comment\nP1,1.5,-2,3.25,\nP2,40,5.0625,-0.6,\"edge, upper \"\"lip\"\"\"\n"},
        Dialect{"byte order mark", "\xEF\xBB\xBFx,y,z\n1.5,-2,3.25\n40,5.0625,-0.6\n"},
        Dialect{"CR alone", "x,y,z\r1.5,-2,3.25\r40,5.0625,-0.6\r"},
        Dialect{"sep line", "sep=;\nx;y;z\n1.5;-2;3.25\n40;5.0625;-0.6\n"},
        Dialect{"sep line with a tab", "\"sep=\t\"\r\nx\ty\tz\r\n1.5\t-2\t3.25\r\n40\t5.0625\t-0.6\r\n"},
        Dialect{"end-of-file mark", "x,y,z\n1.5,-2,3.25\n40,5.0625,-0.6\n\x1A"},
        Dialect{"padding behind the end", "x,y,z\n1.5,-2,3.25\n40,5.0625,-0.6\x1A" + std::string("\x1A\0\0\n", 4)},
        Dialect{"rows of a spreadsheet without values", ",,\nx,y,z\n,,\n1.5,-2,3.25\n40,5.0625,-0.6\n,,\n,,\n"},
        Dialect{"no last line end", "x,y,z\n1.5,-2,3.25\n40,5.0625,-0.6"},
        Dialect{"exponents and signs", "x,y,z\n+15e-1,-2E0,3.25\n4.0e+01,5.0625,-.6\n"},
        Dialect{"units in the names", "X [mm],Y (mm),z_mm\n1.5,-2,3.25\n40,5.0625,-0.6\n"},
        Dialect{"centimetres", "x (cm),y (cm),z (cm)\n.15,-.2,.325\n4,.50625,-.06\n"},
        Dialect{"a line of units", "x,y,z,path\n[mm],[mm],[mm],\n1.5,-2,3.25,1\n40,5.0625,-0.6,1\n"},
        Dialect{"unit in a comment", "# Blade unit no. 5: m\n# Units: [mm],,\nx,y,z\n1.5,-2,3.25\n40,5.0625,-0.6\n"},
        Dialect{"empty directions", "x,y,z,i,j,k,path,weight\n1.5,-2,3.25,,,,,\n40,5.0625,-0.6,,,,,\n"}));

TEST(PointsUnits, AreThoseOfTheFirstLine) {
  for (const std::string names : {"x [in],y [in],z [in]", "X_in,Y_in,Z_in", "x/inch,y/inch,z/inch", "x (Inches),y,z",
                                  "X in,Y in,Z in", "\"x,in\",\"y,in\",\"z,in\""}) {
    const PointsFile file = parse_points_csv(names + "\n1,2,3\n", "a.csv", {});
    if (names.find(",y,") != std::string::npos) {
      EXPECT_NE(file.error.message.find("only 1 of the 3 lengths say their unit"), std::string::npos);
      continue;
    }
    ASSERT_EQ(file.error.message, "") << names;
    EXPECT_EQ(file.points[0].position[0], 25.4) << names;
    ASSERT_EQ(file.notes.size(), 1U) << names;
    EXPECT_NE(file.notes[0].find("lengths in in"), std::string::npos);
  }
  const PointsFile metres = parse_points_csv("x [m],y [m],z [m]\n1,2,3\n", "a.csv", {.unit = Unit::inch});
  EXPECT_EQ(metres.points.at(0).position[0], 1000);
}

TEST(PointsUnits, OfTheUserAreNotContradicted) {
  const PointsFormat given{.given_unit = Unit::mm};
  EXPECT_EQ(parse_points_csv("x [mm],y [mm],z [mm]\n1,2,3\n", "a.csv", given).error.message, "");
  EXPECT_EQ(parse_points_csv("x [in],y [in],z [in]\n1,2,3\n", "a.csv", given).error.message,
            "a.csv: the file gives its lengths in in, but --units says mm; leave --units out, or correct the file");
}

TEST(PointsColumns, GivenByTheUserReadAFileWithoutNames) {
  const PointsFormat format{.columns = "-,x,y,z,i,j,k"};
  for (const std::string text :
       {"P1,1,2,3,0,0,1\n", "P1;1,0;2;3;0;0;1\n", "P1 1 2 3 0 0 1", "P1\t1\t2\t3\t0\t0\t1\n"}) {
    const PointsFile file = parse_points_csv(text, "a.csv", format);
    ASSERT_EQ(file.error.message, "") << text;
    ASSERT_EQ(file.points.size(), 1U);
    EXPECT_EQ(file.points[0].position, (std::array<double, 3>{1, 2, 3}));
    EXPECT_EQ(file.points[0].approach, (std::array<double, 3>{0, 0, 1}));
  }
}

TEST(PointsColumns, GivenByTheUserStandForTheFilesOwnNames) {
  const PointsFile file =
      parse_points_csv("Nominal,X act [in],Y act [in],Z act [in]\n9,1,2,3\n", "a.csv", {.columns = "-,x,y,z"});
  ASSERT_EQ(file.error.message, "");
  EXPECT_EQ(file.points[0].position[0], 25.4);
  EXPECT_EQ(parse_points_csv("z,y,x\n1,2,3\n", "a.csv", {.columns = "x,y,z"}).error.message.substr(0, 8), "a.csv:1:");
}

TEST(PointsColumns, AreCheckedBeforeAnyFile) {
  EXPECT_FALSE(check_point_columns("z,-,y,x,-,weight"));
  for (const char* columns : {"", "x,y", "x,y,z,x", "x,y,z,q", "x,y,z,i", "x;y;z"})
    EXPECT_TRUE(check_point_columns(columns)) << columns;
}

TEST(PointsNotes, NameTheColumnsThatAreNotUsed) {
  const PointsFile file = parse_points_csv("Point,X,Y,Z,Comment\nP1,1,2,3,\n", "a.csv", {});
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_EQ(file.notes[0], "a.csv: columns not used: 'Point', 'Comment'");
}

struct Doubtful {
  std::string text, words;
};

class PointsDoubtful : public ::testing::TestWithParam<Doubtful> {};

TEST_P(PointsDoubtful, AreRefusedInOneLineThatHelps) {
  const PointsFile file = parse_points_csv(GetParam().text, "a.csv", {});
  EXPECT_TRUE(file.points.empty());
  EXPECT_NE(file.error.message.find(GetParam().words), std::string::npos) << file.error.message;
  EXPECT_TRUE(file.error.message.starts_with("a.csv")) << file.error.message;
  EXPECT_LT(file.error.message.size(), 300U) << file.error.message;
}

const std::string kSixLines = "x,y,z\n1.25,2.25,3.25\n1.25,2.25,3.25\n1.25,2.25,3.25\n1.25,2.25,3.25\n1.25,2.25,3.25\n";

INSTANTIATE_TEST_SUITE_P(
    All, PointsDoubtful,
    ::testing::Values(
        Doubtful{"x,y,z\n1,5,-2,0,3,25\n", "a.csv:2: 6 columns where 3 are named"},
        Doubtful{"x;y;z\n1,234;5,678;9,012\n", "a.csv:2: a number such as 1,234 may have a decimal comma"},
        Doubtful{"x,y,z\n\"1,234\",\"5,678\",9\n", "a.csv:2: a number such as 1,234"},
        Doubtful{"x,y,z\n\"1,234.5\",2,3\n", "a.csv:2: column x: '1,234.5': has separators of thousands"},
        Doubtful{"x;y;z\n1.234,5;2,5;3\n", "separators of thousands"},
        Doubtful{"x,y,z\n1.5,2,\"3,25\"\n",
                 "a.csv:2: column z: '3,25': the file has decimal points and decimal commas"},
        Doubtful{"x,y,z\n1'234.5,2,3\n", "column x: '1'234.5': is not a finite number"},
        Doubtful{"x y z\n1 234.5 2 3\n", "4 columns where 3 are named"},
        Doubtful{"x [mm],y [in],z [mm]\n1,2,3\n", "a.csv:1: the unit in contradicts mm"},
        Doubtful{"x [furlong],y,z\n1,2,3\n", "a.csv:1: column 'x [furlong]': 'furlong' is not a unit"},
        Doubtful{"# unit: in\nx [mm],y [mm],z [mm]\n1,2,3\n", "contradicts"},
        Doubtful{"# Units: ft\nx,y,z\n1,2,3\n", "a.csv:1: the unit 'ft' is not known here"},
        Doubtful{"x,y,z\n1,2,3\n# units = in\n", "a.csv:3: a unit is given below the first values"},
        Doubtful{"x,y,z\nmm,in,mm\n1,2,3\n", "a.csv:2: the lengths have different units"},
        Doubtful{"X_nom,Y_nom,Z_nom,X_act,Y_act,Z_act\n1,2,3,4,5,6\n", "column 'x' is missing among 'X_nom'"},
        Doubtful{"X,Y,Z,X,Y,Z\n1,2,3,4,5,6\n", "'x' is named twice"},
        Doubtful{"1,2,3\n4,5,6\n", "a number, '1', stands where a column's name should"},
        Doubtful{"1.5 2.5 3.5\n", "--columns"}, Doubtful{"\xFF\xFEx", "the text is UTF-16; save it as CSV in UTF-8"},
        Doubtful{std::string("x\0,\0y\0", 6), "the text is UTF-16"},
        Doubtful{"PK\x03\x04more", "a workbook or packed file"},
        Doubtful{"x,y,z\n\"1,2,3\n4,5,6\n", "a.csv:2: a quotation mark is not closed"},
        Doubtful{"x,y,z\n\"1\"5,2,3\n", "a.csv:2: text follows a closing quotation mark"},
        Doubtful{"x,y,z\n1,2,3\x1A\n4,5,6\n", "a.csv:2: a control character"},
        Doubtful{"Point,x,y,z\nP1,1,2\n", "a.csv:2: 3 columns where 4 are named"},
        Doubtful{"x,y,z,i,j,k\n1,2,3,,0,1\n", "a.csv:2: column i: it is empty"},
        Doubtful{"x,y,z,,\n1,2,3,,4\n", "'4' stands in column 5, which has no name"},
        Doubtful{"x,y,z\n1,2,3e12\n", "a.csv:2: column z: '3e12' is beyond 1e+09 mm"},
        Doubtful{"x,y,z,weight\n1,2,3,1e300\n", "a.csv:2: column weight: '1e300' is not a number from 1e-09 to 1e+09"},
        Doubtful{kSixLines + "1.25,2.25,3.2", "a.csv:7: the last line has no end"},
        Doubtful{"x,y,z\n" + std::string(70000, '1') + "\n", "a.csv:2: the line is longer than 65536"}));

TEST(PointsDialects, ACompleteLastLineNeedsNoEnd) {
  EXPECT_EQ(parse_points_csv(kSixLines + "1.25,2.25,3.25", "a.csv", {}).points.size(), 6U);
  EXPECT_EQ(parse_points_csv(kSixLines + "1.25,2.25,3.2\n", "a.csv", {}).points.size(), 6U);
}

}  // namespace
}  // namespace bladefit
