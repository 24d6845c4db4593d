#include "tools/design/occ/face_loops.hpp"

#include <fmt/format.h>
#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/geometry/surface/joint.hpp"
#include "tools/design/nurbs/trim_loops.hpp"
#include "tools/design/occ/edge_polygon.hpp"

namespace bladefit {
namespace {

/// Ends of curves that meet may be this far apart in the parameters of the box, as long as they meet in space.
constexpr double kMostParameterGap = 0.05;
/// How far beside a piece the inside of a loop is looked for [pieces].
constexpr double kBeside = 1e-3;

/// Moves a polygon that runs along a side of the box onto it.
void settle_on_sides(EdgePolygon& edge) {
  for (const int axis : {0, 1}) {
    for (const double side : {0.0, 1.0}) {
      const auto near = [&](const Eigen::Vector2d& p) { return std::abs(p[axis] - side) <= kOnSide; };
      if (!std::ranges::all_of(edge.places, near)) continue;
      for (Eigen::Vector2d& place : edge.places) place[axis] = side;
    }
  }
  for (Eigen::Vector2d& place : edge.places) place = place.cwiseMax(0.0).cwiseMin(1.0);
}

/// The curve of an edge in space, where the surface of the face stands before its placement; null where there is none
/// of the same parameter.
Handle(Geom_Curve) curve_before(const TopoDS_Edge& edge, const TopoDS_Face& face) {
  double first = 0, last = 0;
  if (BRep_Tool::Degenerated(edge) || !BRep_Tool::SameParameter(edge)) return {};
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  TopLoc_Location place;
  BRep_Tool::Surface(face, place);
  if (curve.IsNull() || place.IsIdentity()) return curve;
  return Handle(Geom_Curve)::DownCast(curve->Transformed(place.Transformation().Inverted()));
}

/// The curves of a wire, each in the sense of the face that looks along Su x Sv.
std::vector<EdgePolygon> edges_of(const TopoDS_Shape& wire, const TopoDS_Face& face, const FaceBasis& basis,
                                  double tolerance) {
  std::vector<EdgePolygon> edges;
  for (TopExp_Explorer explorer(wire, TopAbs_EDGE); explorer.More(); explorer.Next()) {
    const TopoDS_Edge& edge = TopoDS::Edge(explorer.Current());
    EdgeCurves curves;
    curves.flat = BRep_Tool::CurveOnSurface(edge, face, curves.first, curves.last);
    curves.reversed = edge.Orientation() == TopAbs_REVERSED;
    if (curves.flat.IsNull() || !(curves.first < curves.last)) continue;
    curves.space = curve_before(edge, face);
    edges.push_back(edge_polygon(curves, basis, tolerance));
    settle_on_sides(edges.back());
  }
  return edges;
}

/// Each next is the one that begins nearest to where the last one ends.
std::vector<EdgePolygon> chained(std::vector<EdgePolygon> edges) {
  for (std::size_t k = 1; k < edges.size(); ++k) {
    const Eigen::Vector2d end = edges[k - 1].places.back();
    const auto apart = [&](const EdgePolygon& e) { return (e.places.front() - end).norm(); };
    std::size_t best = k;
    for (std::size_t other = k + 1; other < edges.size(); ++other) {
      if (apart(edges[other]) < apart(edges[best])) best = other;
    }
    std::swap(edges[k], edges[best]);
  }
  return edges;
}

bool bends(const Eigen::Vector3d& before, const Eigen::Vector3d& after) {
  if (before.isZero() || after.isZero()) return true;
  return before.dot(after) < std::cos(kMostBend);
}

/// Where two curves meet; on a side of the box where one of them is.
Eigen::Vector2d meeting(const Eigen::Vector2d& end, const Eigen::Vector2d& begin) {
  Eigen::Vector2d place = begin;
  for (const int axis : {0, 1}) {
    if (end[axis] == 0 || end[axis] == 1) place[axis] = end[axis];
  }
  return place;
}

/// The polygon of a whole wire; `gap`: the widest between two of its curves.
struct WirePolygon {
  TrimLoop loop;
  double gap = 0, parameter_gap = 0;
};

WirePolygon joined(const std::vector<EdgePolygon>& edges) {
  WirePolygon wire;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const EdgePolygon& edge = edges[k];
    const EdgePolygon& before = edges[(k + edges.size() - 1) % edges.size()];
    wire.gap = std::max(wire.gap, (edge.from - before.to).norm());
    wire.parameter_gap = std::max(wire.parameter_gap, (edge.places.front() - before.places.back()).norm());
    // The end of a curve is the beginning of the next one.
    for (std::size_t i = 0; i + 1 < edge.places.size(); ++i) {
      const Eigen::Vector2d place = i > 0 ? edge.places[i] : meeting(before.places.back(), edge.places[0]);
      wire.loop.push_back({place.x(), place.y(), i == 0 && bends(before.last_way, edge.first_way)});
    }
  }
  return wire;
}

/// All of it runs along the sides of the box.
bool on_sides(const TrimLoop& loop) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const TrimVertex &a = loop[k], &b = loop[(k + 1) % loop.size()];
    const bool along = (a.u == b.u && (a.u == 0 || a.u == 1)) || (a.v == b.v && (a.v == 0 || a.v == 1));
    if (!along) return false;
  }
  return true;
}

/// The face is on the left of the piece, on the right, or on both or no sides of it.
int side_of_piece(const std::vector<TrimLoop>& loops, const TrimVertex& a, const TrimVertex& b) {
  const double du = b.u - a.u, dv = b.v - a.v, u = 0.5 * (a.u + b.u), v = 0.5 * (a.v + b.v);
  const bool left = inside_loops(loops, u - kBeside * dv, v + kBeside * du),
             right = inside_loops(loops, u + kBeside * dv, v - kBeside * du);
  return (left ? 1 : 0) - (right ? 1 : 0);
}

/// Turns the loops so that the face is on their left. False where they are tangled: it changes sides along one.
bool turn_to_left(std::vector<TrimLoop>& loops) {
  const std::vector<TrimLoop> given = loops;
  for (TrimLoop& loop : loops) {
    int left = 0, right = 0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int side = side_of_piece(given, loop[k], loop[(k + 1) % loop.size()]);
      left += side > 0 ? 1 : 0;
      right += side < 0 ? 1 : 0;
    }
    if (std::min(left, right) * 20 > left + right) return false;
    if (left < right) std::ranges::reverse(loop);
  }
  return true;
}

}  // namespace

FaceLoops face_loops(const TopoDS_Face& given, const FaceBasis& basis, double tolerance_mm) {
  FaceLoops result;
  const TopoDS_Face face = TopoDS::Face(given.Oriented(TopAbs_FORWARD));
  if (BRep_Tool::NaturalRestriction(face)) return result;
  for (TopExp_Explorer wires(face, TopAbs_WIRE); wires.More(); wires.Next()) {
    const std::vector<EdgePolygon> edges =
        chained(edges_of(wires.Current(), face, basis, tolerance_mm / std::max(basis.scale, 1e-300)));
    if (edges.empty()) continue;
    for (const EdgePolygon& edge : edges) result.off_mm = std::max(result.off_mm, basis.scale * edge.off);
    const WirePolygon wire = joined(edges);
    if (wire.parameter_gap > kMostParameterGap) {
      result.fault = fmt::format("its bounds do not close: {:.2g} mm apart in space, {:.2g} of the box in (u, v)",
                                 basis.scale * wire.gap, wire.parameter_gap);
      result.loops.clear();
      return result;
    }
    if (wire.loop.size() > 1) result.loops.push_back(wire.loop);
  }
  if (std::ranges::all_of(result.loops, on_sides)) {
    result.loops.clear();
  } else if (!turn_to_left(result.loops)) {
    result.fault = "its bounds cross each other";
    result.loops.clear();
  }
  return result;
}

}  // namespace bladefit
