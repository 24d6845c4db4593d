#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/unit/tools/design_file_writing.hpp"
#include "tests/unit/tools/design_fixtures.hpp"
#include "tools/design/load_design.hpp"
#include "tools/design/nurbs/outward_side.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

using Shape = std::function<Eigen::Vector3d(double, double)>;

/// A sheet through points of `shape` at a grid over 0..1 x 0..1, with uniform cubic B-splines in between.
NurbsSurface sheet(const Shape& shape, int count = 24) {
  NurbsSurface surface = testing::random_surface({3, count - 3}, {3, count - 3}, false, 1);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      surface.control_points[static_cast<std::size_t>(i * count + j)] =
          shape(double(i) / (count - 1), double(j) / (count - 1));
    }
  }
  return surface;
}

/// A twisted blade of 300 mm with a thin elliptic section. u goes once around from `begin` to `end` (parts of a turn),
/// v from root to tip, where the section shrinks; root and tip are open.
Shape blade(double begin, double end, double thickness) {
  return [=](double u, double v) {
    const double angle = 2 * std::numbers::pi * (begin + u * (end - begin));
    const double chord = 60 * (1 - 0.6 * v);
    const double x = chord * std::cos(angle);
    const double y = chord * thickness * std::sin(angle);
    const double twist = 0.9 * v;
    return Eigen::Vector3d(x * std::cos(twist) - y * std::sin(twist), x * std::sin(twist) + y * std::cos(twist),
                           300 * v);
  };
}

Shape swapped(const Shape& shape) {
  return [=](double u, double v) { return shape(v, u); };
}

Shape reversed(const Shape& shape) {
  return [=](double u, double v) { return shape(1 - u, v); };
}

int side_of(const std::vector<NurbsSurface>& surfaces) { return find_outward_side(surfaces, "test").sign; }

std::string refusal_of(const std::vector<NurbsSurface>& surfaces) {
  try {
    side_of(surfaces);
  } catch (const ToolError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(DesignOutward, ThinBladeWithAnOpenTrailingEdge) {
  const Shape shape = blade(0.02, 0.98, 0.04);
  EXPECT_EQ(side_of({sheet(shape)}), 1);
  EXPECT_EQ(side_of({sheet(reversed(shape))}), -1);
  EXPECT_EQ(side_of({sheet(swapped(shape))}), -1);
  EXPECT_EQ(side_of({sheet(swapped(reversed(shape)))}), 1);
}

TEST(DesignOutward, TwoAndThreePatches) {
  EXPECT_EQ(side_of({sheet(blade(0, 0.5, 0.05)), sheet(blade(0.5, 1, 0.05))}), 1);
  EXPECT_EQ(side_of({sheet(blade(0.01, 0.4, 0.05)), sheet(blade(0.4, 0.6, 0.05)), sheet(blade(0.6, 0.99, 0.05))}), 1);
  EXPECT_EQ(side_of({sheet(reversed(blade(0.6, 0.99, 0.05))), sheet(reversed(blade(0.01, 0.6, 0.05)))}), -1);
}

TEST(DesignOutward, DoesNotDependOnPlaceAndUnit) {
  const Shape shape = [](double u, double v) {
    return Eigen::Vector3d(25.4 * blade(0.02, 0.98, 0.04)(u, v) + Eigen::Vector3d(5000, -3000, 800));
  };
  EXPECT_EQ(side_of({sheet(shape)}), 1);
}

TEST(DesignOutward, OpenSheetsAreRefused) {
  const std::string wanted = "say --outward +";
  const NurbsSurface flat = testing::random_surface({3, 8}, {3, 8}, false, 2);
  EXPECT_NE(refusal_of({flat}).find(wanted), std::string::npos);
  EXPECT_NE(refusal_of({sheet(blade(0, 0.5, 0.1))}).find(wanted), std::string::npos);
  EXPECT_NE(refusal_of({sheet(blade(0.2, 0.3, 1.0))}).find(wanted), std::string::npos);
}

TEST(DesignOutward, PatchesThatContradictEachOtherAreRefused) {
  const std::string message = refusal_of({sheet(blade(0, 0.5, 0.1)), sheet(reversed(blade(0.5, 1, 0.1)))});
  EXPECT_NE(message.find("do not all point to the same side"), std::string::npos) << message;
}

TEST(DesignOutward, TheSideAskedForIsTaken) {
  const testing::ScratchFolder folder;
  const auto path = folder.write("a.igs", testing::iges_file({testing::iges_surface(sheet(blade(0, 0.5, 0.1)))}));
  EXPECT_THROW(load_design(path, OutwardOption::automatic), ToolError);
  EXPECT_NO_THROW(load_design(path, OutwardOption::minus));
  EXPECT_EQ(parse_outward("+"), OutwardOption::plus);
  EXPECT_EQ(parse_outward("-"), OutwardOption::minus);
  EXPECT_EQ(parse_outward("auto"), OutwardOption::automatic);
  EXPECT_THROW(parse_outward("out"), ToolError);
}

}  // namespace
}  // namespace bladefit
