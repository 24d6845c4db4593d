#include "tools/design/step/step_spline_check.hpp"

#include <fmt/format.h>
#include <StepGeom_BSplineSurfaceWithKnots.hxx>
#include <StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface.hxx>
#include <StepGeom_BezierSurface.hxx>
#include <StepGeom_BezierSurfaceAndRationalBSplineSurface.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_HArray2OfCartesianPoint.hxx>
#include <StepGeom_QuasiUniformSurfaceAndRationalBSplineSurface.hxx>
#include <StepGeom_UniformSurfaceAndRationalBSplineSurface.hxx>
#include <TColStd_HArray1OfInteger.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColStd_HArray2OfReal.hxx>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {
namespace {

/// The library makes no surface of a higher degree.
constexpr int kHighestDegree = 25;

using KnotArray = Handle(TColStd_HArray1OfReal);
using Multiplicities = Handle(TColStd_HArray1OfInteger);

std::string knot_fault(const KnotArray& knots, const Multiplicities& multiplicities, int degree, int points,
                       char letter) {
  if (knots.IsNull() || multiplicities.IsNull()) return fmt::format("its knots in {} are missing", letter);
  if (knots->Length() != multiplicities->Length()) {
    return fmt::format("{} knots in {} but {} multiplicities", knots->Length(), letter, multiplicities->Length());
  }
  std::int64_t sum = 0;
  for (int k = 1; k <= knots->Length(); ++k) {
    const double knot = knots->Value(k);
    const int count = multiplicities->Value(k);
    const bool end = k == 1 || k == knots->Length();
    if (count < 1 || count > degree + 1) {
      return fmt::format("knot {} in {} has multiplicity {}, outside 1..degree + 1 = {}", knot, letter, count,
                         degree + 1);
    }
    if (count == degree + 1 && !end) return fmt::format("the surface is torn at {} = {}", letter, knot);
    if (k > 1 && !(knot > knots->Value(k - 1))) {
      return fmt::format("decreasing knots in {}: {} after {}", letter, knot, knots->Value(k - 1));
    }
    sum += count;
  }
  if (sum == points + degree + 1) return {};
  return fmt::format("{} knots in {}, but {} control points of degree {} need {}", sum, letter, points, degree,
                     points + degree + 1);
}

template <class Knotted>
std::string knots_fault(const Knotted& surface, int points_u, int points_v) {
  const std::string fault = knot_fault(surface.UKnots(), surface.UMultiplicities(), surface.UDegree(), points_u, 'u');
  if (!fault.empty()) return fault;
  return knot_fault(surface.VKnots(), surface.VMultiplicities(), surface.VDegree(), points_v, 'v');
}

/// Whether the entity is a rational one; its weights, null where they are missing.
template <class... Rational>
bool find_weights(const StepGeom_BSplineSurface& surface, Handle(TColStd_HArray2OfReal) & weights) {
  bool rational = false;
  const auto take = [&](const auto* form) {
    if (form == nullptr) return;
    rational = true;
    if (!form->RationalBSplineSurface().IsNull()) weights = form->WeightsData();
  };
  (take(dynamic_cast<const Rational*>(&surface)), ...);
  return rational;
}

bool find_weights(const StepGeom_BSplineSurface& surface, Handle(TColStd_HArray2OfReal) & weights) {
  return find_weights<
      StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface, StepGeom_BezierSurfaceAndRationalBSplineSurface,
      StepGeom_QuasiUniformSurfaceAndRationalBSplineSurface, StepGeom_UniformSurfaceAndRationalBSplineSurface>(surface,
                                                                                                               weights);
}

std::string weight_fault(const StepGeom_BSplineSurface& surface, int points_u, int points_v) {
  Handle(TColStd_HArray2OfReal) weights;
  if (!find_weights(surface, weights)) return {};
  if (weights.IsNull()) return "its weights are missing";
  if (weights->ColLength() != points_u || weights->RowLength() != points_v) {
    return fmt::format("{} x {} weights for {} x {} control points", weights->ColLength(), weights->RowLength(),
                       points_u, points_v);
  }
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (int i = 0; i < points_u; ++i) {
    for (int j = 0; j < points_v; ++j) {
      const double weight = weights->Value(weights->LowerRow() + i, weights->LowerCol() + j);
      if (!(weight > 0)) return fmt::format("weight ({}, {}) is {}, but weights must be above 0", i, j, weight);
      least = std::min(least, weight);
      most = std::max(most, weight);
    }
  }
  if (most <= kLargestWeightRatio * least) return {};
  return fmt::format("its weights differ beyond reason, from {} to {}", least, most);
}

std::string net_fault(const StepGeom_HArray2OfCartesianPoint& points) {
  for (int i = points.LowerRow(); i <= points.UpperRow(); ++i) {
    for (int j = points.LowerCol(); j <= points.UpperCol(); ++j) {
      const Handle(StepGeom_CartesianPoint)& point = points.Value(i, j);
      if (!point.IsNull() && point->NbCoordinates() == 3) continue;
      return fmt::format("control point ({}, {}) is missing or has not three coordinates", i - points.LowerRow(),
                         j - points.LowerCol());
    }
  }
  return {};
}

}  // namespace

Handle(TColStd_HArray2OfReal) weights_of(const StepGeom_BSplineSurface& surface) {
  Handle(TColStd_HArray2OfReal) weights;
  find_weights(surface, weights);
  return weights;
}

std::string spline_fault(const StepGeom_BSplineSurface& surface) {
  const int degree_u = surface.UDegree(), degree_v = surface.VDegree();
  if (degree_u < 1 || degree_u > kHighestDegree || degree_v < 1 || degree_v > kHighestDegree) {
    return fmt::format("degree {} x {} is outside 1..{}", degree_u, degree_v, kHighestDegree);
  }
  if (surface.ControlPointsList().IsNull()) return "its control points are missing";
  const int points_u = surface.ControlPointsList()->ColLength(), points_v = surface.ControlPointsList()->RowLength();
  std::string fault = net_fault(*surface.ControlPointsList());
  if (fault.empty()) fault = weight_fault(surface, points_u, points_v);
  if (!fault.empty()) return fault;
  if (const auto* plain = dynamic_cast<const StepGeom_BSplineSurfaceWithKnots*>(&surface)) {
    return knots_fault(*plain, points_u, points_v);
  }
  using Rational = StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface;
  if (const auto* rational = dynamic_cast<const Rational*>(&surface)) return knots_fault(*rational, points_u, points_v);
  if (points_u <= degree_u || points_v <= degree_v) {
    return fmt::format("{} x {} control points are too few for degree {} x {}", points_u, points_v, degree_u, degree_v);
  }
  const bool bezier = dynamic_cast<const StepGeom_BezierSurface*>(&surface) != nullptr ||
                      dynamic_cast<const StepGeom_BezierSurfaceAndRationalBSplineSurface*>(&surface) != nullptr;
  if (bezier && ((points_u - 1) % degree_u != 0 || (points_v - 1) % degree_v != 0)) {
    return fmt::format("{} x {} control points do not make whole Bezier pieces of degree {} x {}", points_u, points_v,
                       degree_u, degree_v);
  }
  return {};
}

}  // namespace bladefit
