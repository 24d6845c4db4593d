// A propeller's table becomes the blade that it describes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/compiled_design.hpp"
#include "tests/support/process.hpp"
#include "tests/support/reference_design.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/loft/blade_table.hpp"
#include "tools/design/loft/loft.hpp"
#include "tools/design/loft/not_a_knot.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// DTMB propeller 4119, as tests/data/README.md gives it with its sources.
constexpr const char* kTable4119 =
    "r_over_R,c_over_D,P_over_D,f_over_c,t_over_c\n"
    "0.2,.3200,1.1050,.01429,.2055\n0.3,.3635,1.1022,.02318,.1553\n0.4,.4048,1.0983,.02303,.1180\n"
    "0.5,.4392,1.0932,.02182,.09016\n0.6,.4610,1.0879,.02072,.06960\n0.7,.4622,1.0839,.02003,.05418\n"
    "0.8,.4347,1.0811,.01967,.04206\n0.9,.3613,1.0785,.01817,.03321\n0.95,.2775,1.0770,.01631,.03228\n"
    "1.0,.0020,1.0750,.01175,.03160\n";

TEST(NotAKnot, ReproducesCubics) {
  const auto cubic = [](double x) { return ((0.5 * x - 2) * x + 3) * x - 1; };
  std::vector<double> places = {-1, 0.5, 1, 2.5, 4}, values;
  for (const double x : places) values.push_back(cubic(x));
  const NotAKnotSpline spline(places, values);
  for (double x = -1.5; x < 5; x += 0.1) EXPECT_NEAR(spline.at(x), cubic(x), 1e-12) << x;
  const NotAKnotSpline parabola({0, 1, 3}, {0, 1, 9});
  EXPECT_NEAR(parabola.at(2), 4, 1e-12);
}

/// Ordinates that Brockett prints, and the greatest ones.
TEST(Foils, ArePublishedOnes) {
  EXPECT_NEAR(half_thickness(Foil::naca66, 0.45), 0.5, 1e-12);
  EXPECT_NEAR(half_thickness(Foil::naca66, 0.2), 0.4, 1e-12);
  EXPECT_NEAR(half_thickness(Foil::naca66, 1), 0.0333, 1e-12);
  EXPECT_NEAR(mean_line(Foil::naca66, 0.5), 1, 1e-12);
  EXPECT_NEAR(mean_line(Foil::naca66, 0.05), 0.2712, 2e-4);  // Brockett's ordinates of a = 0.8
  EXPECT_NEAR(mean_line(Foil::naca66, 0.3), 0.8635, 2e-4);
  EXPECT_NEAR(mean_line(Foil::naca66, 0.9), 0.3586, 2e-4);
  EXPECT_NEAR(half_thickness(Foil::naca16, 0.5), 0.5, 1e-4);
  EXPECT_NEAR(half_thickness(Foil::naca16, 1), 0.01, 1e-12);
  EXPECT_NEAR(mean_line(Foil::naca16, 0.5), 1, 1e-12);
  EXPECT_NEAR(mean_line(Foil::naca16, 0.05), 0.2864, 1e-4);  // 1.580 of 5.515, Theory of Wing Sections, appendix II
}

/// y^2 = 2 rho x at the nose.
TEST(Foils, KeepTheRadiusOfTheLeadingEdge) {
  for (const Foil foil : {Foil::naca66, Foil::naca16}) {
    const double x = 1e-10, y = half_thickness(foil, x);
    EXPECT_NEAR(y * y / (2 * x), nose_radius(foil), 1e-4);
    EXPECT_EQ(half_thickness(foil, 0), 0);
    EXPECT_NEAR(mean_line(foil, 0), 0, 1e-12);
    EXPECT_NEAR(mean_line(foil, 1), 0, 1e-12);
  }
  EXPECT_NEAR(nose_radius(Foil::naca16), 0.4897, 1e-4);
}

TEST(BladeTable, SectionsLieOnTheirCylindersWithPitchSkewAndRake) {
  const BladeTable table = parse_blade_table(
      "r_over_R;c_over_D;P_over_D;f_over_c;t_over_D;skew;rake_over_D\n"
      "0.3;0.3;1.2;0;0.03;0;0\n0.5;0.3;1.2;0;0.03;10;0.02\n0.7;0.3;1.2;0;0.03;20;0.04\n0.9;0.3;1.2;0;0.03;30;0.06\n",
      "table.csv");
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_NEAR(table.rows[1].thickness, 0.1, 1e-12);
  BladeShape shape{.diameter = 1000};
  shape.sections = 3;
  const BladeSections right = sections_of(table, shape);
  shape.left_handed = true;
  const BladeSections left = sections_of(table, shape);
  const BladeSection& tip = right.sections.back();
  EXPECT_NEAR(*tip.radius, 0.9, 1e-12);
  for (const Eigen::Vector3d& point : tip.points) EXPECT_NEAR(std::hypot(point.y(), point.z()), 450, 1e-9);
  // Without camber the middle between both ends of the chord is the reference point.
  const Eigen::Vector3d nose = tip.points[tip.points.size() / 2], tail = 0.5 * (tip.points.front() + tip.points.back());
  const double nose_angle = std::atan2(-nose.y(), nose.z()), tail_angle = std::atan2(-tail.y(), tail.z());
  EXPECT_NEAR(0.5 * (nose_angle + tail_angle), -30 * std::numbers::pi / 180, 1e-4);  // towards the trailing edge
  const double pitch = 1200 / (2 * std::numbers::pi);                                // advance a radian
  EXPECT_NEAR(0.5 * (nose.x() + tail.x()), -60 - pitch * 30 * std::numbers::pi / 180, 1e-2);
  EXPECT_NEAR((nose.x() - tail.x()) / (nose_angle - tail_angle), pitch, 0.05);
  for (std::size_t k = 0; k < tip.points.size(); ++k) {
    const Eigen::Vector3d& mirrored = left.sections.back().points[k];
    EXPECT_EQ(mirrored.x(), tip.points[k].x());
    EXPECT_EQ(mirrored.y(), -tip.points[k].y());
  }
}

/// The design of tests/data was fitted to the blade of this table within 0.05 mm by other code.
TEST(BladeTable, MakesDtmb4119) {
  BladeShape shape{.diameter = 304.8};
  const BladeSections sections = sections_of(parse_blade_table(kTable4119, "4119.csv"), shape);
  LoftSettings settings;
  settings.follow_points = true;
  settings.knots_at_sections = true;
  const NurbsSurface surface = loft(sections, settings, 1);
  const testing::CompiledDesign made(write_image({surface}, DesignUnit::mm, 1));
  const Surface& reference = testing::reference_design("dtmb4119").surface();
  double largest = 0, sum = 0;
  int count = 0;
  for (double u = 0.01; u < 1; u += 0.02) {
    for (double v = 0.02; v < 1; v += 0.06) {
      const Vec3 point = reference.evaluate(reference.place_at(0, u, v)).s;
      const double off =
          std::sqrt(project_global(made.surface(), {point, Vec3::Zero(), 0}, nullptr).nearest.distance_squared());
      largest = std::max(largest, off);
      sum += off * off;
      ++count;
    }
  }
  EXPECT_LT(largest, 0.06);
  EXPECT_LT(std::sqrt(sum / count), 0.01);
}

std::string table_refusal(const std::string& text) {
  try {
    static_cast<void>(parse_blade_table(text, "t.csv"));
  } catch (const ToolError& error) {
    return error.what();
  }
  return "";
}

TEST(BladeTable, RefusesInOneLine) {
  const std::string names = "r_over_R,c_over_D,P_over_D,f_over_c,t_over_c\n", row = "0.2,0.3,1,0.02,0.1\n";
  EXPECT_NE(table_refusal("r_over_R,c_over_D\n0.2,0.3\n").find("the first line must name the columns"),
            std::string::npos);
  EXPECT_NE(table_refusal(names + row).find("1 rows are too few"), std::string::npos);
  EXPECT_EQ(table_refusal(names + row + "0.2,0.3,1,0.02,0.1\n"),
            "t.csv:3: column r_over_R: 0.2 after 0.2; write the rows from root to tip, each radius once");
  EXPECT_EQ(table_refusal(names + "0.2,30,1,0.02,0.1\n"),
            "t.csv:2: column c_over_D: 30 is out of range; give a number from 1e-06 to 2");
  EXPECT_NE(
      table_refusal("r_over_R,c_over_D,P_over_D,f_over_c\n0.2,0.3,1,0.02\n").find("no column t_over_c or t_over_D"),
      std::string::npos);
}

TEST(LoftCommand, TakesATableOrSections) {
  const hil::ScratchFolder folder;
  const std::string table = folder.write("4119.csv", kTable4119).string(), out = folder / "blade.igs";
  hil::Process done({BLADEFIT_COMMAND, "loft", "--table", table, "--diameter", "304.8", "--units", "mm", "-o", out});
  EXPECT_EQ(done.exit_code(), 0) << done.err();
  const std::vector<std::vector<std::string>> wrong = {
      {"--table", table, "--units", "mm"},
      {"--units", "mm"},
      {table, "--table", table, "--diameter", "300", "--units", "mm"},
      {"--table", table, "--diameter", "300", "--units", "mm", "--control-points", "900"},
      {"--table", table, "--diameter", "300", "--units", "mm", "--section", "naca65"}};
  for (const std::vector<std::string>& arguments : wrong) {
    hil::Process refused(hil::operator+({BLADEFIT_COMMAND, "loft", "-o", out}, arguments));
    EXPECT_EQ(refused.exit_code(), 2) << arguments.back();
    EXPECT_EQ(refused.err().find('\n'), refused.err().size() - 1) << refused.err();
  }
}

}  // namespace
}  // namespace bladefit
