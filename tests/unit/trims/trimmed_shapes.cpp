#include "tests/unit/trims/trimmed_shapes.hpp"

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepLib.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAPI_PointsToBSpline.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom2d_Ellipse.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Plane.hxx>
#include <ShapeFix_Face.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Pln.hxx>

#include <cmath>
#include <numbers>

namespace bladefit::testing {
namespace {

Handle(Geom_Surface) curved_sheet() {
  TColgp_Array2OfPnt points(1, 4, 1, 4);
  for (int i = 1; i <= 4; ++i) {
    for (int j = 1; j <= 4; ++j) {
      points.SetValue(i, j, gp_Pnt(30.0 * i, 30.0 * j + 2.0 * i * i, 3.0 * i * (5 - j) + 2.0 * j * j));
    }
  }
  const Handle(Geom_BezierSurface) bezier = new Geom_BezierSurface(points);
  return GeomConvert::SurfaceToBSplineSurface(bezier);
}

TopoDS_Wire wire_on(const Handle(Geom_Surface) & surface, const std::vector<Handle(Geom2d_Curve)>& curves) {
  BRepBuilderAPI_MakeWire wire;
  for (const Handle(Geom2d_Curve) & curve : curves) wire.Add(BRepBuilderAPI_MakeEdge(curve, surface));
  TopoDS_Wire made = wire.Wire();
  BRepLib::BuildCurves3d(made);
  return made;
}

TopoDS_Face fixed(const TopoDS_Face& face) {
  ShapeFix_Face fix(face);
  fix.Perform();
  fix.FixOrientation();
  return fix.Face();
}

TopoDS_Face face_of(const Handle(Geom_Surface) & surface, const TopoDS_Wire& outer) {
  return fixed(BRepBuilderAPI_MakeFace(surface, outer, Standard_True));
}

TopoDS_Shape plate_with_holes() {
  BRepBuilderAPI_MakePolygon outline;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {100.0, 10.0}, {90.0, 60.0}, {60.0, 40.0}, {20.0, 70.0}}) {
    outline.Add(gp_Pnt(x, y, 0));
  }
  outline.Close();
  const Handle(Geom_Plane) plane = new Geom_Plane(gp_Pln());
  BRepBuilderAPI_MakeFace face(plane, outline.Wire());
  const std::vector<Handle(Geom2d_Curve)> holes = {new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(30, 30), gp_Dir2d(1, 0)), 9),
                                                   new Geom2d_Ellipse(gp_Ax2d(gp_Pnt2d(65, 22), gp_Dir2d(1, 1)), 8, 3),
                                                   new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(30, 50), gp_Dir2d(1, 0)), 0.5)};
  for (const Handle(Geom2d_Curve) & hole : holes) {
    TopoDS_Wire wire = wire_on(plane, {hole});
    wire.Reverse();
    face.Add(wire);
  }
  return fixed(face.Face());
}

/// With a round hole of the parameters, and a corner cut off along a wavy curve.
TopoDS_Shape sheet_with_hole() {
  const Handle(Geom_Surface) surface = curved_sheet();
  BRepBuilderAPI_MakeFace face(surface, 1e-6);
  TopoDS_Wire hole = wire_on(surface, {new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(0.5, 0.45), gp_Dir2d(1, 0)), 0.2)});
  hole.Reverse();
  face.Add(hole);
  return fixed(face.Face());
}

/// Between two wavy curves that meet in points: wide in the middle, a tenth of a millimetre, or a few hundredths.
TopoDS_Face leaf_shape(double middle, double width) {
  const Handle(Geom_Surface) surface = curved_sheet();
  const auto curve = [&](double sign) -> Handle(Geom2d_Curve) {
    TColgp_Array1OfPnt2d points(1, 15);
    for (int k = 0; k < 15; ++k) {
      const double t = k / 14.0;
      points.SetValue(k + 1, gp_Pnt2d(0.1 + 0.8 * t,
                                      middle + 0.05 * std::sin(5 * t) + sign * width * std::sin(std::numbers::pi * t)));
    }
    const Handle(Geom2d_BSplineCurve) spline = Geom2dAPI_PointsToBSpline(points).Curve();
    return spline.get();
  };
  return face_of(surface, wire_on(surface, {curve(-1), curve(1)}));
}

TopoDS_Shape slivers() {
  TopoDS_Compound all;
  BRep_Builder builder;
  builder.MakeCompound(all);
  builder.Add(all, leaf_shape(0.2, 0.08));
  builder.Add(all, leaf_shape(0.55, 1e-3));
  builder.Add(all, leaf_shape(0.8, 2e-4));
  return all;
}

/// A section like a lens with round ends: a closed spline about the z axis.
TopoDS_Wire section(double z, double chord, double thickness, double turn) {
  constexpr int kPoints = 24;
  TColgp_Array1OfPnt points(1, kPoints + 1);
  for (int k = 0; k <= kPoints; ++k) {
    const double angle = 2 * std::numbers::pi * (k % kPoints) / kPoints;
    const double x = 0.5 * chord * std::cos(angle),
                 y = 0.5 * thickness * std::sin(angle) + 0.1 * chord * (1 - std::pow(2 * x / chord, 2));
    points.SetValue(k + 1, gp_Pnt(x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn), z));
  }
  const Handle(Geom_BSplineCurve) curve = GeomAPI_PointsToBSpline(points, 3, 8, GeomAbs_C2, 1e-4).Curve();
  return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(curve));
}

TopoDS_Shape blade_body() {
  BRepOffsetAPI_ThruSections loft(Standard_True, Standard_False, 1e-5);
  for (int k = 0; k <= 4; ++k) {
    loft.AddWire(section(15.0 + 20.0 * k, 36.0 - 4.0 * k, 8.0 - 1.0 * k, 0.15 * k));
  }
  loft.Build();
  return loft.Shape();
}

/// Lies along x, its upper side at z = 20.
TopoDS_Shape hub() { return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-40, 0, 0), gp_Dir(1, 0, 0)), 20.0, 80.0).Shape(); }

bool near_hub(const TopoDS_Edge& edge) {
  double first = 0, last = 0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  if (curve.IsNull()) return false;
  for (const double share : {0.1, 0.5, 0.9}) {
    const gp_Pnt p = curve->Value(first + share * (last - first));
    if (std::abs(std::hypot(p.Y(), p.Z()) - 20.0) > 1e-3 || std::abs(p.X()) > 25 || p.Z() < 5) return false;
  }
  return true;
}

TopoDS_Shape blade_with_fillet() {
  const TopoDS_Shape fused = BRepAlgoAPI_Fuse(blade_body(), hub()).Shape();
  BRepFilletAPI_MakeFillet fillet(fused);
  for (TopExp_Explorer edges(fused, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
    if (near_hub(edge)) fillet.Add(3.0, edge);
  }
  fillet.Build();
  return fillet.Shape();
}

/// The bore passes beside the poles, which stay on the face, and not over the seam.
TopoDS_Shape bored_ball() {
  const gp_Ax2 beside(gp_Pnt(-22, 0, -60), gp_Dir(0, 0, 1));
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(50.0).Shape(), BRepPrimAPI_MakeCylinder(beside, 15.0, 120.0).Shape())
      .Shape();
}

/// Its tip cut by a cylinder about the hub, as tips are.
TopoDS_Shape blade_with_trimmed_tip() {
  const TopoDS_Shape limit = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-60, 0, 0), gp_Dir(1, 0, 0)), 70.0, 120.0).Shape();
  return BRepAlgoAPI_Common(blade_body(), limit).Shape();
}

/// The skin of the blade, closed around it, in two faces on either side of a slanted plane.
TopoDS_Shape two_half_faces() {
  TopTools_ListOfShape arguments, tools;
  arguments.Append(blade_body());
  tools.Append(BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 1, 50), gp_Dir(0.1, 1, 0.05)), -100, 100, -100, 100).Shape());
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(arguments);
  splitter.SetTools(tools);
  splitter.Build();
  // Of both bodies the faces on the skin: those of the loft, which no plane holds.
  TopoDS_Compound skin;
  BRep_Builder builder;
  builder.MakeCompound(skin);
  for (TopExp_Explorer faces(splitter.Shape(), TopAbs_FACE); faces.More(); faces.Next()) {
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(TopoDS::Face(faces.Current()));
    if (!Handle(Geom_BSplineSurface)::DownCast(surface).IsNull()) builder.Add(skin, faces.Current());
  }
  return skin;
}

}  // namespace

TopoDS_Shape propeller_body(int blades) {
  TopoDS_Shape body = hub();
  for (int k = 0; k < blades; ++k) {
    gp_Trsf turn;
    turn.SetRotation(gp_Ax1(gp_Pnt(), gp_Dir(1, 0, 0)), 2 * std::numbers::pi * k / blades);
    body = BRepAlgoAPI_Fuse(body, BRepBuilderAPI_Transform(blade_body(), turn).Shape()).Shape();
  }
  const gp_Ax2 along_x(gp_Pnt(-50, 0, 0), gp_Dir(1, 0, 0));
  body = BRepAlgoAPI_Cut(body, BRepPrimAPI_MakeCylinder(along_x, 8.0, 100.0).Shape()).Shape();
  return BRepAlgoAPI_Cut(body, BRepPrimAPI_MakeBox(gp_Pnt(-50, -2, 0), gp_Pnt(50, 2, 11)).Shape()).Shape();
}

TrimmedShape trimmed_shape(std::size_t index) {
  switch (index) {
    case 0:
      return {"plate with holes", plate_with_holes()};
    case 1:
      return {"sheet with a hole", sheet_with_hole()};
    case 2:
      return {"slivers", slivers()};
    case 3:
      return {"two half faces", two_half_faces()};
    case 4:
      return {"trimmed tip", blade_with_trimmed_tip(), true};
    case 5:
      return {"root fillet", blade_with_fillet(), true};
    default:
      return {"bored ball", bored_ball(), true};
  }
}

}  // namespace bladefit::testing
