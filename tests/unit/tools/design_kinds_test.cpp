// Files as CAD systems write them beyond the plain ones: texts, surfaces and sides.
#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <STEPControl_Writer.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Ax3.hxx>

#include <numbers>

#include "core/geometry/surface/surface.hpp"
#include "tests/unit/tools/design_file_writing.hpp"
#include "tests/unit/tools/design_image_reading.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/load_design.hpp"
#include "tools/design/occ/cad_session.hpp"
#include "tools/design/read_design.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

using testing::replaced;
using testing::ScratchFolder;

const NurbsSurface kSheet = testing::random_surface({3, 2}, {2, 2}, true, 31);

std::string sheet_step() {
  int number = 100;
  return testing::step_file(testing::step_surface(kSheet, "PATCH1", number));
}

std::string sheet_iges() { return testing::iges_file({testing::iges_surface(kSheet)}); }

DesignFile read_as(const std::string& name, const std::string& content) {
  const ScratchFolder folder;
  return read_design(folder.write(name, content));
}

void expect_sheet(const std::string& name, const std::string& content) {
  const DesignFile design = read_as(name, content);
  ASSERT_EQ(design.surfaces.size(), 1U);
  EXPECT_EQ(design.surfaces[0].control_points, kSheet.control_points);
}

std::string refusal(const std::string& name, const std::string& content) {
  try {
    read_as(name, content);
  } catch (const ToolError& error) {
    EXPECT_LT(std::string(error.what()).size(), 400U);
    return error.what();
  }
  return "accepted";
}

void expect_refusal(const std::string& name, const std::string& content, const std::string& wanted) {
  const std::string message = refusal(name, content);
  EXPECT_NE(message.find(wanted), std::string::npos) << "got: " << message << "\nwanted: " << wanted;
}

/// The lines of an IGES file, changed one by one, with another line end.
template <class Change>
std::string relined(const std::string& text, const char* end, Change change) {
  std::string result;
  for (std::size_t at = 0; at < text.size(); at += 81) result += change(text.substr(at, 80)) + end;
  return result;
}

TEST(DesignKinds, RealsWithASmallExponentLetterOrWithoutAPointAreReadRight) {
  const std::string first = testing::real_text(kSheet.control_points[0].x());
  for (const char* twin : {"25e-1", "2.5e0", "25E-1", "2.5E+0", ".25E1"}) {
    const DesignFile design =
        read_as("a.stp", replaced(sheet_step(), "(" + first + ",", std::string("(") + twin + ","));
    EXPECT_EQ(design.surfaces.at(0).control_points[0].x(), 2.5) << twin;
  }
}

TEST(DesignKinds, StepReferencesThatLeadNowhereTwiceOrBackAreRefusedWithTheLine) {
  expect_refusal("a.stp", replaced(sheet_step(), "=ADVANCED_FACE('PATCH1',()", "=ADVANCED_FACE('PATCH1',(#4711)"),
                 "#4711 is referred to but not in the file");
  expect_refusal("a.stp", replaced(sheet_step(), "#101=", "#100="),
                 "line 11: #100 is given a second time, first on line 10");
  expect_refusal(
      "a.stp",
      replaced(sheet_step(), "#28=SHELL_BASED_SURFACE_MODEL('',(#27))", "#28=SHELL_BASED_SURFACE_MODEL('',(#28))"),
      "#28 refers to itself");
  expect_refusal("a.stp", replaced(sheet_step(), "#20=", "#20=X(" + std::string(100000, '(')), "parentheses inside");
}

TEST(DesignKinds, StepTextsOfOtherSystemsAreRead) {
  expect_sheet("a.p21", "\xEF\xBB\xBF" + sheet_step());
  expect_sheet("a.stp", replaced(sheet_step(), "REPRESENTATION_ITEM('')", "REPRESENTATION_ITEM($)"));
  expect_sheet("a.step", sheet_step() + std::string("\x1a\0", 2));
}

TEST(DesignKinds, IgesTextsOfOtherSystemsAreRead) {
  const auto same = [](const std::string& line) { return line; };
  expect_sheet("a.igs", relined(sheet_iges(), "\r", same));
  expect_sheet("a.igs", "\xEF\xBB\xBF" + relined(sheet_iges(), "\r\n", same));
  expect_sheet("a.igs", relined(sheet_iges(), "\n", [](const std::string& line) { return line.substr(0, 73); }));
  expect_sheet("a.igs", relined(sheet_iges(), "", same));
  expect_sheet("a.igs", sheet_iges() + "\x1a");
  expect_sheet("a.igs", sheet_iges() + "written by a program of 1987\n\n");
}

TEST(DesignKinds, AMissingParameterRangeIsThatOfTheKnotsAndTold) {
  IgesOutputEntity entity = testing::iges_surface(kSheet);
  const auto cut_fields = [&](int count) {
    std::string text = entity.parameters;
    for (int k = 0; k < count; ++k) text.erase(text.rfind(','));
    return text;
  };
  for (const std::string& end : {std::string(), std::string(",0.,0.,0.,0."), std::string(",0,0")}) {
    const DesignFile design = read_as("a.igs", testing::iges_file({{128, cut_fields(4) + end, 0, ""}}));
    EXPECT_EQ(design.surfaces.at(0).control_points, kSheet.control_points);
    ASSERT_EQ(design.warnings.size(), 2U);
    EXPECT_NE(design.warnings[0].find("U0, U1 is missing"), std::string::npos) << design.warnings[0];
  }
}

TEST(DesignKinds, IgesReferencesThatLeadNowhereOrBackAreRefused) {
  const IgesOutputEntity sheet = testing::iges_surface(kSheet);
  expect_refusal("a.igs", testing::iges_file({sheet, {144, "144,99,0,0,0", 0, ""}}), "refers to D99, which is not");
  expect_refusal("a.igs", testing::iges_file({sheet, {402, "402,2,1,3", 0, "", 7}}), "402 at D3 refers to itself");
  expect_refusal("a.igs", testing::iges_file({testing::iges_surface(kSheet, 1)}), "is not an entity 124");
}

TEST(DesignKinds, HiddenSurfacesAreLeftOutUnlessAVisibleOneStandsOnThem) {
  IgesOutputEntity hidden = testing::iges_surface(kSheet), shown = testing::iges_surface(kSheet);
  hidden.status = "01000000";
  const DesignFile design = read_as("a.igs", testing::iges_file({hidden, shown}));
  EXPECT_EQ(design.surfaces.size(), 1U);
  ASSERT_EQ(design.warnings.size(), 1U);
  EXPECT_NE(design.warnings[0].find("1 hidden"), std::string::npos);
  hidden.status = "01010000";
  EXPECT_EQ(read_as("a.igs", testing::iges_file({hidden, {144, "144,1,0,0,0", 0, ""}})).surfaces.size(), 1U);
  hidden.status = "01000000";
  expect_refusal("a.igs", testing::iges_file({hidden}), "hidden");
}

TEST(DesignKinds, TheMatrixOfAnOwnerMovesItsSurface) {
  const DesignFile design =
      read_as("a.igs", testing::iges_file({{124, "124,1.,0.,0.,5.,0.,1.,0.,6.,0.,0.,1.,7.", 0, ""},
                                           testing::iges_surface(kSheet),
                                           {144, "144,3,0,0,0", 1, ""}}));
  const Eigen::Vector3d moved = kSheet.control_points[3] + Eigen::Vector3d(5, 6, 7);
  EXPECT_LT((design.surfaces.at(0).control_points[3] - moved).norm(), 1e-12 * moved.norm());
}

DesignFile read_face(const TopoDS_Face& face) {
  const ScratchFolder folder;
  const std::filesystem::path path = folder.path() / "face.stp";
  {
    const QuietMessages quiet;
    STEPControl_Writer writer;
    EXPECT_EQ(writer.Transfer(face, STEPControl_AsIs), IFSelect_RetDone);
    EXPECT_EQ(writer.Write(path.c_str()), IFSelect_RetDone);
  }
  return read_design(path);
}

TEST(DesignKinds, CylindersAndSpheresBecomeSplinesExactly) {
  const Handle(Geom_Surface) cylinder = new Geom_CylindricalSurface(gp_Ax3(), 40.0),
                             sphere = new Geom_SphericalSurface(gp_Ax3(), 40.0);
  for (const auto& [surface, low, high, height] :
       {std::tuple{cylinder, 0.3, 2.0, 50.0}, {cylinder, 0.0, 2 * std::numbers::pi, 50.0}, {sphere, 0.5, 6.0, 1.2}}) {
    const DesignFile design = read_face(BRepBuilderAPI_MakeFace(surface, low, high, 0.0, height, 1e-6));
    ASSERT_EQ(design.surfaces.size(), 1U);
    EXPECT_EQ(design.faces[0].kind, surface == cylinder ? "cylinder" : "sphere");
    for (const double u : {0.0, 0.2, 0.55, 1.0}) {
      const Eigen::Vector3d point = testing::evaluate_surface(design.surfaces[0], u, 0.4);
      EXPECT_NEAR(surface == cylinder ? point.head<2>().norm() : point.norm(), 40.0, 1e-11);
    }
    const double area = surface == cylinder ? 40 * (high - low) * height : 1600 * (high - low) * std::sin(height);
    EXPECT_NEAR(design.faces[0].area, area, 1e-3 * area);
  }
}

TEST(DesignKinds, TheSenseOfAFaceIsFollowed) {
  const Handle(Geom_Surface) cylinder = new Geom_CylindricalSurface(gp_Ax3(), 40.0);
  TopoDS_Face face = BRepBuilderAPI_MakeFace(cylinder, 0.3, 2.0, 0.0, 50.0, 1e-6);
  EXPECT_FALSE(read_face(face).surfaces.at(0).reversed);
  face.Reverse();
  EXPECT_TRUE(read_face(face).surfaces.at(0).reversed);
}

TEST(DesignKinds, EachPatchOfAnImageHasItsOwnSide) {
  NurbsSurface reversed = kSheet;
  reversed.reversed = true;
  for (const int sign : {1, -1}) {
    const std::vector<std::byte> bytes = write_image({kSheet, reversed}, DesignUnit::mm, sign);
    const DesignImage image = testing::open_image(bytes);
    const Surface surface(image);
    const auto normal = [&](std::uint32_t patch) {
      const SurfacePlace place = surface.place_at(patch, 0.4, 0.6);
      return surface.normal(place, surface.evaluate(place));
    };
    const SurfacePlace place = surface.place_at(0, 0.4, 0.6);
    const SurfacePoint at = surface.evaluate(place);
    EXPECT_GT(sign * normal(0).dot(at.s_u.cross(at.s_v)), 0.0);
    EXPECT_EQ(normal(1), -normal(0));
    EXPECT_EQ(testing::check_cones(image, 3), 0);
  }
}

TEST(DesignKinds, FilesThatCannotBeReadNameTheWayOn) {
  expect_refusal("a.jt", "x", "as STEP");
  expect_refusal("a.stl", "x", "a mesh has no surface");
  expect_refusal("a.zip", "x", "unpack it");
  expect_refusal("a.gz", "x", "unknown kind of design");
  expect_refusal("a.igs", "solid blade\n", "mesh");
  EXPECT_THROW(read_design("/dev/zero"), ToolError);
  const ScratchFolder folder;
  std::filesystem::create_symlink("/dev/zero", folder.path() / "a.stp");
  EXPECT_THROW(read_design(folder.path() / "a.stp"), ToolError);
  const auto large = folder.write("b.stp", "ISO-10303-21;");
  std::filesystem::resize_file(large, std::uintmax_t{1} << 30U);
  EXPECT_THROW(read_design(large), ToolError);
}

TEST(DesignKinds, FacesAreChosenByNumberNameOrPattern) {
  const ScratchFolder folder;
  int number = 100;
  std::string statements = testing::step_surface(kSheet, "SUCTION", number);
  statements += testing::step_surface(testing::random_surface({}, {}, true, 32), "HUB", number);
  statements += testing::step_surface(testing::random_surface({}, {}, true, 33), "SUCTION_TIP", number);
  const auto path = folder.write("a.stp", testing::step_file(statements));
  const auto patches = [&](const std::vector<std::string>& faces) {
    return testing::open_image(load_design(path, DesignChoice(OutwardOption::plus, faces)).image).patches().size();
  };
  EXPECT_EQ(patches({}), 3U);
  EXPECT_EQ(patches({"SUCTION*"}), 2U);
  EXPECT_EQ(patches({"HUB", "0"}), 2U);
  EXPECT_THROW(patches({"PRESSURE"}), ToolError);
  EXPECT_THROW(patches({"3"}), ToolError);
}

}  // namespace
}  // namespace bladefit
