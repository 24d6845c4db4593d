#include "tools/design/occ/face_surface.hpp"

#include <fmt/format.h>
#include <BRep_Tool.hxx>
#include <GeomConvert.hxx>
#include <GeomConvert_ApproxSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Precision.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/geometry/surface/design_image.hpp"
#include "tools/design/nurbs/patch_split.hpp"
#include "tools/design/nurbs/trim_loops.hpp"
#include "tools/design/occ/face_loops.hpp"
#include "tools/design/occ/face_trim.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// Areas are taken from this many places in each direction, and of trimmed faces along so many lines between two.
constexpr int kAreaGrid = 32, kAreaLines = 8;
/// An approximation is compared at this many places in each direction.
constexpr int kErrorGrid = 25;
constexpr int kApproximationDegree = 8, kApproximationSpans = 400;

/// OpenCASCADE's names of surfaces and those of the trade.
constexpr std::array<std::pair<std::string_view, const char*>, 11> kKinds = {
    {{"Geom_BSplineSurface", "B-spline"},
     {"Geom_BezierSurface", "Bezier"},
     {"Geom_Plane", "plane"},
     {"Geom_CylindricalSurface", "cylinder"},
     {"Geom_ConicalSurface", "cone"},
     {"Geom_SphericalSurface", "sphere"},
     {"Geom_ToroidalSurface", "torus"},
     {"Geom_SurfaceOfRevolution", "surface of revolution"},
     {"Geom_SurfaceOfLinearExtrusion", "linear extrusion"},
     {"Geom_OffsetSurface", "offset surface"},
     {"GeomPlate_Surface", "plate"}}};

/// The surface under a face before its placement, without the cut that some files wrap around it.
Handle(Geom_Surface) basis_of(const TopoDS_Face& face) {
  TopLoc_Location place;
  Handle(Geom_Surface) surface = BRep_Tool::Surface(face, place);
  for (;;) {
    const auto part = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface);
    if (part.IsNull()) return surface;
    surface = part->BasisSurface();
  }
}

/// Any other surface over a box as a B-spline; a full turn stays whole.
Handle(Geom_BSplineSurface) converted(const Handle(Geom_Surface) & surface, const FaceBox& box) {
  const auto finite = [](double value) { return !Precision::IsInfinite(value); };
  if (!finite(box.u_min) || !finite(box.u_max) || !finite(box.v_min) || !finite(box.v_max)) {
    throw ToolError("has no bounds");
  }
  const auto whole = [](double from, double to, double low, double high) {
    return from <= low && to >= high && !Precision::IsInfinite(low) && !Precision::IsInfinite(high);
  };
  double u_low = 0, u_high = 0, v_low = 0, v_high = 0;
  surface->Bounds(u_low, u_high, v_low, v_high);
  const bool whole_u = whole(box.u_min, box.u_max, u_low, u_high), whole_v = whole(box.v_min, box.v_max, v_low, v_high);
  if (whole_u && whole_v) return GeomConvert::SurfaceToBSplineSurface(surface);
  Handle(Geom_RectangularTrimmedSurface) part;
  if (whole_u) {
    part = new Geom_RectangularTrimmedSurface(surface, box.v_min, box.v_max, Standard_False);
  } else if (whole_v) {
    part = new Geom_RectangularTrimmedSurface(surface, box.u_min, box.u_max, Standard_True);
  } else {
    part = new Geom_RectangularTrimmedSurface(surface, box.u_min, box.u_max, box.v_min, box.v_max);
  }
  return GeomConvert::SurfaceToBSplineSurface(part);
}

double largest_distance(const Geom_Surface& a, const Geom_Surface& b) {
  double u_low = 0, u_high = 0, v_low = 0, v_high = 0, largest = 0;
  b.Bounds(u_low, u_high, v_low, v_high);
  for (int i = 0; i < kErrorGrid; ++i) {
    for (int j = 0; j < kErrorGrid; ++j) {
      const double u = u_low + (u_high - u_low) * i / (kErrorGrid - 1),
                   v = v_low + (v_high - v_low) * j / (kErrorGrid - 1);
      largest = std::max(largest, a.Value(u, v).Distance(b.Value(u, v)));
    }
  }
  return largest;
}

/// A surface of the core's degrees within a tolerance; what that made of it goes to `error_mm`.
Handle(Geom_BSplineSurface) approximated(const Handle(Geom_Surface) & surface, double tolerance_mm, double& error_mm) {
  const GeomConvert_ApproxSurface fit(surface, tolerance_mm, GeomAbs_C1, GeomAbs_C1, kApproximationDegree,
                                      kApproximationDegree, kApproximationSpans, 1);
  if (!fit.HasResult()) throw ToolError("cannot be approximated");
  error_mm = largest_distance(*surface, *fit.Surface());
  if (error_mm > 10 * tolerance_mm) {
    throw ToolError(fmt::format("can be approximated within {:.2g} mm only", error_mm));
  }
  return fit.Surface();
}

/// One direction of a B-spline as OpenCASCADE holds it.
struct SplineDirection {
  int degree, poles;
  bool periodic;
  const TColStd_Array1OfReal& flat;   ///< knots, each as often as it counts
  const TColStd_Array1OfReal& knots;  ///< each once
  int first_multiplicity;
};

/// Where a direction begins and ends: of a periodic one one turn, or two where the face goes over its seam. `from` and
/// `to` are moved by turns into that range.
SurfaceDirection unrolled(const SplineDirection& d, double& from, double& to) {
  SurfaceDirection result;
  result.degree = d.degree;
  if (!d.periodic) {
    result.control_points = d.poles;
    result.knots.assign(d.flat.begin(), d.flat.end());
  } else {
    const double low = d.knots.First(), period = d.knots.Last() - low;
    const double turns = std::floor((from - low) / period + Precision::PConfusion());
    from -= turns * period;
    to -= turns * period;
    const int count = to > low + period * (1 + Precision::PConfusion()) ? 2 : 1;
    // The knots of one turn stand in the flat sequence from the first copy of the first knot on.
    const int before = d.degree + 1 - d.first_multiplicity;
    result.control_points = count * d.poles + before;
    for (int k = 0; k < result.control_points + d.degree + 1; ++k) {
      const int place = k - before;
      const int turn = place >= 0 ? place / d.poles : -((d.poles - 1 - place) / d.poles);
      result.knots.push_back(d.flat(d.flat.Lower() + before + place - turn * d.poles) + turn * period);
    }
  }
  result.start = result.knots[static_cast<std::size_t>(d.degree)];
  result.end = result.knots[static_cast<std::size_t>(result.control_points)];
  return result;
}

/// The control points in their place, `box` in the range of the knots. Those of periodic surfaces are repeated, not
/// computed.
NurbsSurface nurbs_of(const Geom_BSplineSurface& surface, const TopLoc_Location& place, FaceBox& box) {
  NurbsSurface result;
  result.u = unrolled({surface.UDegree(), surface.NbUPoles(), static_cast<bool>(surface.IsUPeriodic()),
                       surface.UKnotSequence(), surface.UKnots(), surface.UMultiplicity(1)},
                      box.u_min, box.u_max);
  result.v = unrolled({surface.VDegree(), surface.NbVPoles(), static_cast<bool>(surface.IsVPeriodic()),
                       surface.VKnotSequence(), surface.VKnots(), surface.VMultiplicity(1)},
                      box.v_min, box.v_max);
  const bool moved = !place.IsIdentity();
  for (int i = 0; i < result.u.control_points; ++i) {
    for (int j = 0; j < result.v.control_points; ++j) {
      const int row = 1 + i % surface.NbUPoles(), column = 1 + j % surface.NbVPoles();
      gp_Pnt pole = surface.Pole(row, column);
      if (moved) pole.Transform(place.Transformation());
      result.control_points.emplace_back(pole.X(), pole.Y(), pole.Z());
      result.weights.push_back(surface.Weight(row, column));
    }
  }
  return result;
}

/// Only the part over `box` of the knots' own parameters; all of it is left as it is.
NurbsSurface cut_to(NurbsSurface surface, const FaceBox& box) {
  const auto normalised = [](const SurfaceDirection& d, double value) {
    return std::clamp((value - d.start) / (d.end - d.start), 0.0, 1.0);
  };
  const ParameterRectangle part{normalised(surface.u, box.u_min), normalised(surface.u, box.u_max),
                                normalised(surface.v, box.v_min), normalised(surface.v, box.v_max)};
  if (part.u_min == 0 && part.u_max == 1 && part.v_min == 0 && part.v_max == 1) return surface;
  if (!(part.u_min < part.u_max && part.v_min < part.v_max)) throw ToolError("its bounds have no width");
  return part_of(surface, part);
}

/// Length of the part of from..to that lies inside of crossings_at().
double length_inside(const std::vector<double>& crossings, double from, double to) {
  double length = 0;
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
    length += std::max(0.0, std::min(to, crossings[k + 1]) - std::max(from, crossings[k]));
  }
  return length;
}

/// Area of the face, and its share of the box: of cells whose part inside of the loops is taken along lines.
void measure(const Geom_Surface& surface, const FaceBox& box, double scale, FaceSurface& result) {
  double whole = 0;
  const double du = (box.u_max - box.u_min) / kAreaGrid, dv = (box.v_max - box.v_min) / kAreaGrid;
  for (int j = 0; j < kAreaGrid; ++j) {
    std::array<std::vector<double>, kAreaLines> lines;
    for (int k = 0; k < kAreaLines; ++k) {
      lines[static_cast<std::size_t>(k)] = crossings_at(result.surface.trims, (j + (k + 0.5) / kAreaLines) / kAreaGrid);
    }
    for (int i = 0; i < kAreaGrid; ++i) {
      gp_Pnt point;
      gp_Vec along_u, along_v;
      surface.D1(box.u_min + (i + 0.5) * du, box.v_min + (j + 0.5) * dv, point, along_u, along_v);
      const double area = scale * scale * along_u.Crossed(along_v).Magnitude() * du * dv;
      double inside = 0;
      for (const auto& line : lines) {
        inside += kAreaGrid * length_inside(line, i / double{kAreaGrid}, (i + 1) / double{kAreaGrid}) / kAreaLines;
      }
      whole += area;
      result.area += area * (result.surface.trims.empty() ? 1 : inside);
    }
  }
  result.share = whole > 0 ? result.area / whole : 1;
}

/// Moves what was found in the face's own frame to where the file puts it, by a factor `scale` larger.
void move_to(const Eigen::Affine3d& place, double scale, FaceSurface& found) {
  for (Eigen::Vector3d& point : found.surface.control_points) point = place * point;
  found.area *= scale * scale;
  found.approximated *= scale;
  found.trims_off *= scale;
  if (place.linear().determinant() < 0) found.surface.reversed = !found.surface.reversed;
}

bool over_degree(const Geom_BSplineSurface& surface) {
  return std::max(surface.UDegree(), surface.VDegree()) > static_cast<int>(kMaxDegree);
}

/// The surface as OpenCASCADE places the face.
FaceSurface surface_in_frame(const CadFace& face, double tolerance_mm) {
  TopLoc_Location place;
  BRep_Tool::Surface(face.face, place);
  const Handle(Geom_Surface) basis = basis_of(face.face);
  FaceBox box = face_box(face.face);
  FaceSurface result;
  result.kind = kind_of(face);
  Handle(Geom_Surface) part;
  Handle(Geom_BSplineSurface) spline = Handle(Geom_BSplineSurface)::DownCast(basis);
  const bool fit = spline.IsNull() ? result.kind == "offset surface" : over_degree(*spline);
  if (fit) {
    part = new Geom_RectangularTrimmedSurface(basis, box.u_min, box.u_max, box.v_min, box.v_max);
  } else if (spline.IsNull()) {
    spline = converted(basis, box);
    if (over_degree(*spline)) part = spline;
  }
  if (!part.IsNull()) spline = approximated(part, tolerance_mm, result.approximated);
  FaceBasis trimmed{basis, box, spline, box, std::abs(place.Transformation().ScaleFactor())};
  if (spline != basis) spline->Bounds(box.u_min, box.u_max, box.v_min, box.v_max);
  trimmed.spline_box = box;
  FaceLoops loops = face_loops(face.face, trimmed, tolerance_mm);
  result.surface = cut_to(nurbs_of(*spline, place, box), box);
  result.surface.trims = std::move(loops.loops);
  measure(*spline, trimmed.spline_box, trimmed.scale, result);
  result.trims_off = loops.off_mm;
  result.trims_fault = std::move(loops.fault);
  // Neither the scale nor the axes alone tell a mirror.
  const bool mirrored = place.Transformation().VectorialPart().Determinant() < 0;
  result.surface.reversed = (face.face.Orientation() == TopAbs_REVERSED) != mirrored;
  return result;
}

}  // namespace

std::string kind_of(const CadFace& face) {
  const std::string_view type = basis_of(face.face)->DynamicType()->Name();
  const auto found = std::ranges::find(kKinds, type, &std::pair<std::string_view, const char*>::first);
  return found != kKinds.end() ? found->second : std::string(type);
}

FaceSurface face_surface(const CadFace& face, double tolerance_mm) {
  if (face.place.matrix().isIdentity(0)) return surface_in_frame(face, tolerance_mm);
  const double scale = std::cbrt(std::abs(face.place.linear().determinant()));
  FaceSurface found = surface_in_frame(face, tolerance_mm / scale);
  move_to(face.place, scale, found);
  return found;
}

}  // namespace bladefit
