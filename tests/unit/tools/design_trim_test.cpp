// Faces bounded inside their surface are told, whole ones are not; the files are written by OpenCASCADE.
#include <gtest/gtest.h>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <Geom2d_Circle.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Writer.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>

#include "tests/support/process.hpp"
#include "tests/unit/tools/design_fixtures.hpp"
#include "tests/unit/tools/design_image_reading.hpp"
#include "tools/design/load_design.hpp"
#include "tools/design/occ/cad_session.hpp"
#include "tools/design/read_design.hpp"

namespace bladefit {
namespace {

constexpr double kPrecision = 1e-6;

/// A curved sheet of about 100 mm.
Handle(Geom_Surface) sheet() {
  TColgp_Array2OfPnt points(1, 4, 1, 4);
  for (int i = 1; i <= 4; ++i) {
    for (int j = 1; j <= 4; ++j) points.SetValue(i, j, gp_Pnt(30.0 * i, 30.0 * j, 4.0 * i * (5 - j)));
  }
  const Handle(Geom_BezierSurface) bezier = new Geom_BezierSurface(points);
  return GeomConvert::SurfaceToBSplineSurface(bezier);
}

TopoDS_Face whole() { return BRepBuilderAPI_MakeFace(sheet(), kPrecision); }

TopoDS_Face cut_along_one_side() { return BRepBuilderAPI_MakeFace(sheet(), 0.0, 0.7, 0.0, 1.0, kPrecision); }

/// The outer bounds are the natural ones.
TopoDS_Face with_a_hole() {
  const Handle(Geom_Surface) surface = sheet();
  const Handle(Geom2d_Circle) circle = new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(0.5, 0.5), gp_Dir2d(1, 0)), 0.2);
  TopoDS_Wire hole = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle, surface)).Wire();
  BRepLib::BuildCurves3d(hole);
  hole.Reverse();
  const TopoDS_Face outer = BRepBuilderAPI_MakeFace(surface, kPrecision);
  return BRepBuilderAPI_MakeFace(outer, hole);
}

std::filesystem::path write_step(const testing::ScratchFolder& folder, const TopoDS_Face& face) {
  const std::filesystem::path path = folder.path() / "sheet.stp";
  const QuietMessages quiet;
  STEPControl_Writer writer;
  EXPECT_EQ(writer.Transfer(face, STEPControl_AsIs), IFSelect_RetDone);
  EXPECT_EQ(writer.Write(path.c_str()), IFSelect_RetDone);
  return path;
}

std::filesystem::path write_iges(const testing::ScratchFolder& folder, const TopoDS_Face& face, int brep_mode) {
  const std::filesystem::path path = folder.path() / "sheet.igs";
  const QuietMessages quiet;
  IGESControl_Writer writer("MM", brep_mode);
  EXPECT_TRUE(writer.AddShape(face));
  writer.ComputeModel();
  EXPECT_TRUE(writer.Write(path.c_str()));
  return path;
}

std::string warning_of(const std::filesystem::path& path) { return load_design(path, OutwardOption::plus).warning; }

void expect_warning(const std::filesystem::path& path, const std::string& face) {
  const std::string warning = warning_of(path);
  EXPECT_EQ(warning.find(path.string() + ": trimmed faces are used up to the (u, v) box"), 0U) << warning;
  EXPECT_NE(warning.find(face), std::string::npos) << warning;
  EXPECT_NE(warning.find(": 12 %"), std::string::npos) << warning;  // a hole of radius 0.2 of 1 x 1
  EXPECT_EQ(warning.find('\n'), std::string::npos);
}

/// The surface is cut where the face ends: its corners, in whatever order a writer puts them, are those of the face.
void expect_cut(const std::filesystem::path& path) {
  EXPECT_EQ(warning_of(path), "");
  const DesignFile design = read_design(path);
  ASSERT_EQ(design.surfaces.size(), 1U);
  const NurbsSurface& part = design.surfaces[0];
  const Handle(Geom_Surface) surface = sheet();
  for (const double u : {0.0, 0.7}) {
    for (const double v : {0.0, 1.0}) {
      const gp_Pnt corner = surface->Value(u, v);
      double least = 1e9;
      for (const double s : {0.0, 1.0}) {
        for (const double t : {0.0, 1.0}) {
          const Eigen::Vector3d found = testing::evaluate_surface(part, s, t);
          least = std::min(least, (found - Eigen::Vector3d(corner.X(), corner.Y(), corner.Z())).norm());
        }
      }
      EXPECT_LT(least, 1e-10);
    }
  }
}

TEST(DesignTrim, StepFacesAreCutAtTheBoxOfTheirTrimAndWhatIsBesideItIsTold) {
  const testing::ScratchFolder folder;
  EXPECT_EQ(warning_of(write_step(folder, whole())), "");
  expect_cut(write_step(folder, cut_along_one_side()));
  expect_warning(write_step(folder, with_a_hole()), "face #");
}

TEST(DesignTrim, IgesFacesAreCutAtTheBoxOfTheirTrimAndWhatIsBesideItIsTold) {
  const testing::ScratchFolder folder;
  for (const auto& [mode, face] : {std::pair{0, "entity 144 at D"}, {1, "entity 510 at D"}}) {
    SCOPED_TRACE(face);
    EXPECT_EQ(warning_of(write_iges(folder, whole(), mode)), "");
    expect_cut(write_iges(folder, cut_along_one_side(), mode));
    expect_warning(write_iges(folder, with_a_hole(), mode), face);
  }
}

TEST(DesignTrim, EveryCommandWarnsOnStandardError) {
  const testing::ScratchFolder folder;
  const std::string design = write_step(folder, with_a_hole());
  const std::vector<std::vector<std::string>> commands = {
      {"compile", design, "--outward", "+", "-o", folder.path() / "sheet.bfd"},
      {"localize", "--design", design, "--outward", "+", "--points", hil::data_file("dtmb4119/subsets/050.csv")},
      {"run", "--design", design, "--outward", "+", "--source", "modbus-tcp://127.0.0.1:1", "--session",
       folder.path() / "session", "--panel", "127.0.0.1:0", "--headless"}};
  for (const std::vector<std::string>& command : commands) {
    hil::Process process(hil::operator+({BLADEFIT_COMMAND}, command));
    EXPECT_TRUE(process.exit_code()) << command[0];
    EXPECT_EQ(process.err().find("bladefit: warning: " + design + ": trimmed faces"), 0U) << process.err();
  }
}

TEST(DesignTrim, TheReferenceDesignsAreWhole) {
  for (const char* const name : {"arl_3patch", "dtmb4119", "pnsy_3patch"}) {
    for (const char* const file : {"design.igs", "design.stp"}) {
      EXPECT_EQ(load_design(std::filesystem::path(BLADEFIT_TEST_DATA) / name / file, OutwardOption::plus).warning, "");
    }
  }
}

}  // namespace
}  // namespace bladefit
