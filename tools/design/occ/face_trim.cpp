#include "tools/design/occ/face_trim.hpp"

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>

#include <cmath>

namespace bladefit {
namespace {

/// What is nearer to a natural bound than this share of the range lies on it: boundary curves are approximations.
constexpr double kOnBound = 1e-4;

/// Moves one end of an interval to the natural bound that it means.
void settle(double& value, double low, double high) {
  if (Precision::IsInfinite(low) || Precision::IsInfinite(high)) return;
  const double margin = kOnBound * (high - low);
  if (std::abs(value - low) <= margin) value = low;
  if (std::abs(value - high) <= margin) value = high;
}

/// Parameters outside of the natural bounds have no surface, unless it is periodic.
void settle(double& from, double& to, double low, double high, bool periodic) {
  settle(from, low, high);
  settle(to, low, high);
  if (periodic) {
    if (to - from >= (1.0 - kOnBound) * (high - low)) to = from + (high - low);
    return;
  }
  from = std::max(from, low);
  to = std::min(to, high);
}

}  // namespace

FaceBox face_box(const TopoDS_Face& face) {
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
  FaceBox natural{}, box{};
  surface->Bounds(natural.u_min, natural.u_max, natural.v_min, natural.v_max);
  if (BRep_Tool::NaturalRestriction(face) || !TopExp_Explorer(face, TopAbs_EDGE).More()) return natural;
  BRepTools::UVBounds(face, box.u_min, box.u_max, box.v_min, box.v_max);
  settle(box.u_min, box.u_max, natural.u_min, natural.u_max, surface->IsUPeriodic());
  settle(box.v_min, box.v_max, natural.v_min, natural.v_max, surface->IsVPeriodic());
  return box;
}

}  // namespace bladefit
