// Faces bounded inside their surface have loops, whole ones have none; the files are written by OpenCASCADE.
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

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/nearest/global_projection.hpp"
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

/// Two loops, the sides and a hole of radius 0.2 of 1 x 1, and a note on them.
void expect_hole(const std::filesystem::path& path) {
  const LoadedDesign loaded = load_design(path, OutwardOption::plus);
  EXPECT_EQ(loaded.warning, "");
  const auto note = std::ranges::find_if(
      loaded.notes, [](const std::string& line) { return line.find("1 trimmed face with 2 loops, within ") == 0; });
  EXPECT_NE(note, loaded.notes.end());
  const DesignFile design = read_design(path);
  ASSERT_EQ(design.surfaces.size(), 1U);
  EXPECT_NEAR(design.faces[0].share, 1 - 0.04 * std::numbers::pi, 0.01);  // of the area, on a grid
  std::size_t round = 0;
  for (const TrimLoop& loop : design.surfaces[0].trims) {
    for (const TrimVertex& vertex : loop) {
      const double radius = std::hypot(vertex.u - 0.5, vertex.v - 0.5);
      if (std::abs(radius - 0.2) < 1e-4) ++round;
    }
  }
  EXPECT_GT(round, 100U);
  const DesignImage image = testing::open_image(loaded.image);
  const Surface surface(image);
  const SurfacePlace middle = surface.place_at(0, 0.5, 0.5);
  const Projection foot = project_global(surface, {surface.evaluate(middle).s}, nullptr).nearest;
  EXPECT_TRUE(foot.on_trim());
  EXPECT_GT(foot.offset.norm(), 10.0);
  EXPECT_EQ(foot_of(surface, foot, 0.0).border, FootBorder::outer);
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

TEST(DesignTrim, StepFacesAreCutAtTheBoxOfTheirTrimAndHaveLoopsInside) {
  const testing::ScratchFolder folder;
  EXPECT_EQ(warning_of(write_step(folder, whole())), "");
  expect_cut(write_step(folder, cut_along_one_side()));
  expect_hole(write_step(folder, with_a_hole()));
}

TEST(DesignTrim, IgesFacesAreCutAtTheBoxOfTheirTrimAndHaveLoopsInside) {
  const testing::ScratchFolder folder;
  for (const int mode : {0, 1}) {
    SCOPED_TRACE(mode);
    EXPECT_EQ(warning_of(write_iges(folder, whole(), mode)), "");
    expect_cut(write_iges(folder, cut_along_one_side(), mode));
    expect_hole(write_iges(folder, with_a_hole(), mode));
  }
}

TEST(DesignTrim, TheReferenceDesignsAreWhole) {
  for (const char* const name : {"arl_3patch", "dtmb4119", "pnsy_3patch"}) {
    for (const char* const file : {"design.igs", "design.stp"}) {
      const std::filesystem::path path = std::filesystem::path(BLADEFIT_TEST_DATA) / name / file;
      EXPECT_EQ(load_design(path, OutwardOption::plus).warning, "");
      for (const NurbsSurface& surface : read_design(path).surfaces) EXPECT_TRUE(surface.trims.empty());
    }
  }
}

}  // namespace
}  // namespace bladefit
