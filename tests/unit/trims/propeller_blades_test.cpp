// One blade out of a whole propeller, as OpenCASCADE writes it.
#include <gtest/gtest.h>
#include <STEPControl_Writer.hxx>

#include <numbers>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/trims/trimmed_shapes.hpp"
#include "tools/design/blade_choice.hpp"
#include "tools/design/blades/design_blades.hpp"
#include "tools/design/load_design.hpp"
#include "tools/design/occ/cad_session.hpp"
#include "tools/design/read_design.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// Where the middle of a blade of the tests' propellers is.
constexpr double kMiddle_mm = 50;

std::filesystem::path written(const TopoDS_Shape& shape, const testing::ScratchFolder& folder) {
  const std::filesystem::path path = folder.path() / "propeller.stp";
  const QuietMessages quiet;
  STEPControl_Writer writer;
  EXPECT_EQ(writer.Transfer(shape, STEPControl_AsIs), IFSelect_RetDone);
  EXPECT_EQ(writer.Write(path.c_str()), IFSelect_RetDone);
  return path;
}

Eigen::Vector3d middle_of(const DesignFile& design) {
  Eigen::AlignedBox3d box;
  for (const NurbsSurface& surface : design.surfaces) {
    for (const Eigen::Vector3d& point : surface.control_points) box.extend(point);
  }
  return box.center();
}

std::string refusal_of(DesignFile design, std::size_t number, const std::optional<ShaftAxis>& axis) {
  try {
    keep_blade(design, number, axis, "p.stp");
  } catch (const ToolError& error) {
    return error.what();
  }
  return "accepted";
}

/// The design turned so that x becomes z, z becomes y.
void turn_and_move(DesignFile& design, const Eigen::Vector3d& shift) {
  for (NurbsSurface& surface : design.surfaces) {
    for (Eigen::Vector3d& point : surface.control_points)
      point = Eigen::Vector3d(point.y(), point.z(), point.x()) + shift;
  }
}

class Propeller : public ::testing::TestWithParam<int> {};

TEST_P(Propeller, EachBladeIsFoundAndNumberedFromPlusYAsTheRightHandTurns) {
  const testing::ScratchFolder folder;
  const int blades = GetParam();
  const DesignFile whole = read_design(written(testing::propeller_body(blades), folder));
  const DesignBlades found = find_blades(whole.surfaces, std::nullopt);
  ASSERT_EQ(found.blades.size(), static_cast<std::size_t>(blades));
  EXPECT_EQ(found.axis.direction, Eigen::Vector3d::UnitX());
  EXPECT_GE(found.hub.size(), 2U);
  EXPECT_GE(found.others.size(), 3U) << "the keyway";
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < blades; ++k) {
    const double angle =
        std::remainder(0.5 * std::numbers::pi + 2 * std::numbers::pi * k / blades, 2 * std::numbers::pi);
    nearest = std::min(nearest, std::abs(angle));
  }
  for (std::size_t k = 0; k < found.blades.size(); ++k) {
    EXPECT_EQ(found.blades[k].faces.size(), found.blades[0].faces.size());
    DesignFile one = whole;
    keep_blade(one, k + 1, std::nullopt, "p.stp");
    const Eigen::Vector3d middle = middle_of(one);
    EXPECT_NEAR(middle.tail<2>().norm(), kMiddle_mm, 12);
    const double turn = std::atan2(middle.z(), middle.y()) - 2 * std::numbers::pi * static_cast<double>(k) / blades;
    EXPECT_NEAR(std::abs(std::remainder(turn, 2 * std::numbers::pi)), nearest, 0.15);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Propeller, ::testing::Values(2, 3, 4, 5));

TEST(PropellerBlade, IsWhatTheDesignHoldsAndIsTold) {
  const testing::ScratchFolder folder;
  const std::filesystem::path path = written(testing::propeller_body(4), folder);
  DesignChoice choice(OutwardOption::automatic);
  choice.blade = 2;  // along +z
  const LoadedDesign loaded = load_design(path, choice);
  DesignImage image;
  ASSERT_EQ(DesignImage::open(loaded.image, image), Status::ok);
  EXPECT_GT(image.header().box_min[2], 15.0);
  std::string notes;
  for (const std::string& note : loaded.notes) notes += note + "\n";
  EXPECT_NE(
      notes.find("blade 2 of 4 blades about x, numbered as the right hand turns about it, from that nearest to +y"),
      std::string::npos)
      << notes;
  choice.faces = {"*"};
  EXPECT_THROW(load_design(path, choice), ToolError);
  const std::vector<std::string> lines = blade_lines(read_design(path));
  ASSERT_EQ(lines.size(), 7U);
  EXPECT_EQ(lines[2].find("  --blade 2: 88 degrees, faces "), 0U) << lines[2];
}

TEST(PropellerBlade, IsFoundAboutAnotherAxisThatDoesNotPassTheOrigin) {
  const testing::ScratchFolder folder;
  DesignFile design = read_design(written(testing::propeller_body(3), folder));
  const Eigen::Vector3d shift(300, -200, 40);
  turn_and_move(design, shift);
  ShaftAxis axis{shift, Eigen::Vector3d::UnitZ()};
  EXPECT_EQ(find_blades(design.surfaces, axis).blades.size(), 3U);
  const DesignBlades found = find_blades(design.surfaces, std::nullopt);
  EXPECT_EQ(found.blades.size(), 3U) << "through the middle, for the keyway is small";
  DesignFile one = design;
  keep_blade(one, 1, axis, "p.stp");
  EXPECT_GT(middle_of(one).y(), shift.y() + 30);
}

TEST(PropellerBlade, ThatCannotBeToldIsRefusedWithBothWaysOut) {
  const testing::ScratchFolder folder;
  const DesignFile design = read_design(written(testing::propeller_body(3), folder));
  EXPECT_NE(refusal_of(design, 4, std::nullopt).find("the design has 3 blades about x"), std::string::npos);
  const std::string wrong_axis = refusal_of(design, 1, ShaftAxis{{0, 0, 500}, Eigen::Vector3d::UnitX()});
  EXPECT_NE(wrong_axis.find("choose the faces of one with --face"), std::string::npos) << wrong_axis;
  EXPECT_NE(wrong_axis.find("correct --axis"), std::string::npos) << wrong_axis;
  DesignFile single = design;
  keep_blade(single, 1, std::nullopt, "p.stp");
  EXPECT_NE(refusal_of(single, 1, std::nullopt).find("--axis"), std::string::npos);
}

TEST(PropellerBlade, WhoseTwoSidesDoNotMeetTakesBoth) {
  const testing::ScratchFolder folder;
  DesignFile design = read_design(written(testing::propeller_body(3), folder));
  const DesignBlades whole = find_blades(design.surfaces, std::nullopt);
  ASSERT_EQ(whole.blades.size(), 3U);
  // Of each blade the skin and a copy that stands half a millimetre off it.
  DesignFile loose;
  for (const DesignBlade& blade : whole.blades) {
    for (const double scale : {1.0, 0.97}) {
      for (const std::size_t face : blade.faces) {
        loose.surfaces.push_back(design.surfaces[face]);
        for (Eigen::Vector3d& point : loose.surfaces.back().control_points) point.tail<2>() *= scale;
        loose.faces.push_back(design.faces[face]);
      }
    }
  }
  const DesignBlades found = find_blades(loose.surfaces, std::nullopt);
  ASSERT_EQ(found.blades.size(), 3U);
  for (const DesignBlade& blade : found.blades) EXPECT_EQ(blade.faces.size(), 2 * whole.blades[0].faces.size());
}

}  // namespace
}  // namespace bladefit
