#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/unit/tools/design_file_writing.hpp"
#include "tests/unit/tools/design_fixtures.hpp"
#include "tools/design/choose_sides.hpp"
#include "tools/design/load_design.hpp"
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

/// Faces named F0, F1, ...; with `told` the file says to which side they look.
DesignFile design_of(const std::vector<NurbsSurface>& surfaces, bool told = false) {
  DesignFile design;
  design.surfaces = surfaces;
  design.faces.resize(surfaces.size());
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    design.faces[k].name = fmt::format("F{}", k);
    design.faces[k].told = told;
  }
  return design;
}

int side_of(const std::vector<NurbsSurface>& surfaces, const OutwardChoice& asked = {}) {
  DesignFile design = design_of(surfaces);
  return choose_sides(design, asked, "test").sign;
}

/// The outward side of every surface, +1 that of Su x Sv.
std::vector<int> sides_of(DesignFile design, const OutwardChoice& asked = {}) {
  const int sign = choose_sides(design, asked, "test").sign;
  std::vector<int> sides;
  for (const NurbsSurface& surface : design.surfaces) sides.push_back(surface.reversed ? -sign : sign);
  return sides;
}

std::string refusal_of(DesignFile design, const OutwardChoice& asked = {}) {
  try {
    choose_sides(design, asked, "test");
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
  EXPECT_NE(refusal_of(design_of({flat})).find(wanted), std::string::npos);
  EXPECT_NE(refusal_of(design_of({sheet(blade(0, 0.5, 0.1))})).find(wanted), std::string::npos);
  EXPECT_NE(refusal_of(design_of({sheet(blade(0.2, 0.3, 1.0))})).find(wanted), std::string::npos);
}

std::vector<NurbsSurface> one_reversed() { return {sheet(blade(0, 0.5, 0.1)), sheet(reversed(blade(0.5, 1, 0.1)))}; }

TEST(DesignOutward, LooseFacesAreTurnedAsTheShapeTells) {
  EXPECT_EQ(sides_of(design_of(one_reversed())), (std::vector<int>{1, -1}));
  EXPECT_EQ(sides_of(design_of({sheet(reversed(blade(0.01, 0.4, 0.05))), sheet(blade(0.4, 0.6, 0.05)),
                                sheet(blade(0.6, 0.99, 0.05))})),
            (std::vector<int>{-1, 1, 1}));
}

TEST(DesignOutward, SidesOfTheFileAreFollowedOrTheContradictionIsToldNeverTurned) {
  DesignFile good = design_of(one_reversed(), true);
  good.surfaces[1].reversed = true;
  EXPECT_EQ(sides_of(good), (std::vector<int>{1, -1}));
  const std::string message = refusal_of(design_of(one_reversed(), true));
  EXPECT_NE(message.find("do not all point to the same side"), std::string::npos) << message;
  EXPECT_NE(message.find("--outward"), std::string::npos) << message;
}

TEST(DesignOutward, OneSideForFacesThatContradictEachOtherIsRefused) {
  const std::string message = refusal_of(design_of(one_reversed()), OutwardOption::plus);
  EXPECT_NE(message.find("by the shape patch 1 (F1) looks the other way"), std::string::npos) << message;
}

TEST(DesignOutward, SidesAreGivenFaceByFace) {
  OutwardChoice list;
  list.faces = {{"F1", true}, {"0", false}};
  EXPECT_EQ(sides_of(design_of(one_reversed()), list), (std::vector<int>{-1, 1}));
  list.faces = {{"F1", false}};
  EXPECT_EQ(sides_of(design_of(one_reversed()), list), (std::vector<int>{1, -1}));
  list.faces = {{"F0", true}, {"*", false}};
  EXPECT_EQ(sides_of(design_of(one_reversed()), list), (std::vector<int>{1, -1}));
  list.faces = {{"TIP", true}};
  EXPECT_NE(refusal_of(design_of(one_reversed()), list).find("no face is called \"TIP\""), std::string::npos);
}

TEST(DesignOutward, TheSideAskedForIsTaken) {
  const testing::ScratchFolder folder;
  const auto path = folder.write("a.igs", testing::iges_file({testing::iges_surface(sheet(blade(0, 0.5, 0.1)))}));
  EXPECT_THROW(load_design(path, OutwardOption::automatic), ToolError);
  EXPECT_NO_THROW(load_design(path, OutwardOption::minus));
  EXPECT_EQ(outward_choice("auto"), OutwardChoice(OutwardOption::automatic));
  EXPECT_THROW(outward_choice("out"), ToolError);
}

}  // namespace
}  // namespace bladefit
