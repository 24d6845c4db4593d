#include "tools/design/step/step_surface.hpp"

#include <fmt/format.h>
#include <StepGeom_BSplineSurfaceWithKnots.hxx>
#include <StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface.hxx>
#include <StepGeom_BezierSurface.hxx>
#include <StepGeom_BezierSurfaceAndRationalBSplineSurface.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_HArray2OfCartesianPoint.hxx>
#include <StepGeom_QuasiUniformSurface.hxx>
#include <StepGeom_QuasiUniformSurfaceAndRationalBSplineSurface.hxx>
#include <StepGeom_UniformSurface.hxx>
#include <StepGeom_UniformSurfaceAndRationalBSplineSurface.hxx>
#include <TColStd_HArray1OfInteger.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColStd_HArray2OfReal.hxx>

#include <algorithm>

#include "core/geometry/surface/design_image.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// Distinct knots and how often each stands, as STEP writes them.
struct KnotTable {
  std::vector<double> knots;
  std::vector<int> multiplicities;
};
struct KnotTables {
  KnotTable u, v;
};

/// The entity being read, for messages.
struct Source {
  std::string file, name;
  [[noreturn]] void fail(const std::string& what) const {
    throw ToolError(fmt::format("{}: {}: {}; export the design again", file, name, what));
  }
};

template <class Knotted>
KnotTables explicit_knots(const Knotted& entity, const Source& source) {
  if (entity.UKnots().IsNull() || entity.VKnots().IsNull() || entity.UMultiplicities().IsNull() ||
      entity.VMultiplicities().IsNull()) {
    source.fail("knots or multiplicities are missing");
  }
  KnotTables tables;
  tables.u.knots.assign(entity.UKnots()->begin(), entity.UKnots()->end());
  tables.v.knots.assign(entity.VKnots()->begin(), entity.VKnots()->end());
  tables.u.multiplicities.assign(entity.UMultiplicities()->begin(), entity.UMultiplicities()->end());
  tables.v.multiplicities.assign(entity.VMultiplicities()->begin(), entity.VMultiplicities()->end());
  return tables;
}

/// Knots first, first + 1, ... : `count` of them, the ends `end_multiplicity` fold and the inner ones
/// `inner_multiplicity` fold.
KnotTable implied_knots(int first, int count, int end_multiplicity, int inner_multiplicity) {
  KnotTable table;
  for (int k = 0; k < count; ++k) {
    table.knots.push_back(first + k);
    table.multiplicities.push_back(k == 0 || k == count - 1 ? end_multiplicity : inner_multiplicity);
  }
  return table;
}

KnotTable bezier_knots(int degree, int points, const Source& source) {
  if ((points - 1) % degree != 0) {
    source.fail(fmt::format("{} control points do not make whole Bezier pieces of degree {}", points, degree));
  }
  return implied_knots(0, (points - 1) / degree + 1, degree + 1, degree);
}

KnotTable quasi_uniform_knots(int degree, int points) { return implied_knots(0, points - degree + 1, degree + 1, 1); }

KnotTable uniform_knots(int degree, int points) { return implied_knots(-degree, points + degree + 1, 1, 1); }

template <class Plain, class Rational>
bool is_either(const StepGeom_BSplineSurface& entity) {
  return entity.IsKind(STANDARD_TYPE(Plain)) || entity.IsKind(STANDARD_TYPE(Rational));
}

KnotTables read_knots(const StepGeom_BSplineSurface& entity, int points_u, int points_v, const Source& source) {
  using Rational = StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface;
  if (const auto* plain = dynamic_cast<const StepGeom_BSplineSurfaceWithKnots*>(&entity)) {
    return explicit_knots(*plain, source);
  }
  if (const auto* rational = dynamic_cast<const Rational*>(&entity)) return explicit_knots(*rational, source);
  const int degree_u = entity.UDegree();
  const int degree_v = entity.VDegree();
  if (is_either<StepGeom_BezierSurface, StepGeom_BezierSurfaceAndRationalBSplineSurface>(entity)) {
    return {bezier_knots(degree_u, points_u, source), bezier_knots(degree_v, points_v, source)};
  }
  if (is_either<StepGeom_QuasiUniformSurface, StepGeom_QuasiUniformSurfaceAndRationalBSplineSurface>(entity)) {
    return {quasi_uniform_knots(degree_u, points_u), quasi_uniform_knots(degree_v, points_v)};
  }
  if (is_either<StepGeom_UniformSurface, StepGeom_UniformSurfaceAndRationalBSplineSurface>(entity)) {
    return {uniform_knots(degree_u, points_u), uniform_knots(degree_v, points_v)};
  }
  source.fail("a B-spline surface without knots");
}

template <class Rational>
Handle(TColStd_HArray2OfReal) weights_as(const StepGeom_BSplineSurface& entity, const Source& source) {
  const auto* rational = dynamic_cast<const Rational*>(&entity);
  if (rational == nullptr) return {};
  if (rational->RationalBSplineSurface().IsNull() || rational->WeightsData().IsNull())
    source.fail("weights are missing");
  return rational->WeightsData();
}

/// The weights of a rational surface, null for a polynomial one.
Handle(TColStd_HArray2OfReal) read_weights(const StepGeom_BSplineSurface& entity, const Source& source) {
  Handle(TColStd_HArray2OfReal) weights =
      weights_as<StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface>(entity, source);
  if (weights.IsNull()) weights = weights_as<StepGeom_BezierSurfaceAndRationalBSplineSurface>(entity, source);
  if (weights.IsNull()) weights = weights_as<StepGeom_QuasiUniformSurfaceAndRationalBSplineSurface>(entity, source);
  if (weights.IsNull()) weights = weights_as<StepGeom_UniformSurfaceAndRationalBSplineSurface>(entity, source);
  return weights;
}

SurfaceDirection make_direction(int degree, int points, const KnotTable& table, char letter, const Source& source) {
  if (table.knots.size() != table.multiplicities.size()) {
    source.fail(
        fmt::format("{} knots in {} but {} multiplicities", table.knots.size(), letter, table.multiplicities.size()));
  }
  SurfaceDirection direction;
  direction.degree = degree;
  direction.control_points = points;
  for (std::size_t k = 0; k < table.knots.size(); ++k) {
    const int multiplicity = table.multiplicities[k];
    if (multiplicity < 1 || multiplicity > degree + 1) {
      source.fail(fmt::format("knot {} in {} has multiplicity {}, outside 1..degree + 1 = {}", table.knots[k], letter,
                              multiplicity, degree + 1));
    }
    direction.knots.insert(direction.knots.end(), static_cast<std::size_t>(multiplicity), table.knots[k]);
  }
  const auto needed = static_cast<std::size_t>(points) + static_cast<std::size_t>(degree) + 1;
  if (direction.knots.size() != needed) {
    source.fail(fmt::format("{} knots in {}, but {} control points of degree {} need {}", direction.knots.size(),
                            letter, points, degree, needed));
  }
  direction.start = direction.knots[static_cast<std::size_t>(degree)];
  direction.end = direction.knots[static_cast<std::size_t>(points)];
  return direction;
}

void append_point(const Handle(StepGeom_CartesianPoint) & point, double mm, NurbsSurface& surface,
                  const Source& source) {
  if (point.IsNull() || point->NbCoordinates() != 3) {
    source.fail(
        fmt::format("control point {} is missing or has not three coordinates", surface.control_points.size() + 1));
  }
  surface.control_points.emplace_back(mm * point->CoordinatesValue(1), mm * point->CoordinatesValue(2),
                                      mm * point->CoordinatesValue(3));
}

void read_net(const StepGeom_BSplineSurface& entity, double mm, NurbsSurface& surface, const Source& source) {
  const Handle(StepGeom_HArray2OfCartesianPoint) points = entity.ControlPointsList();
  const Handle(TColStd_HArray2OfReal) weights = read_weights(entity, source);
  if (!weights.IsNull() &&
      (weights->ColLength() != points->ColLength() || weights->RowLength() != points->RowLength())) {
    source.fail(fmt::format("{} x {} weights for {} x {} control points", weights->ColLength(), weights->RowLength(),
                            points->ColLength(), points->RowLength()));
  }
  for (int i = 0; i < points->ColLength(); ++i) {
    for (int j = 0; j < points->RowLength(); ++j) {
      append_point(points->Value(points->LowerRow() + i, points->LowerCol() + j), mm, surface, source);
      surface.weights.push_back(weights.IsNull() ? 1.0
                                                 : weights->Value(weights->LowerRow() + i, weights->LowerCol() + j));
    }
  }
}

}  // namespace

NurbsSurface read_step_surface(const Handle(StepGeom_BSplineSurface) & entity, const std::string& name, double mm,
                               const std::string& file) {
  const Source source{file, name};
  const int highest = static_cast<int>(kMaxDegree);
  if (entity->UDegree() < 1 || entity->UDegree() > highest || entity->VDegree() < 1 || entity->VDegree() > highest) {
    source.fail(fmt::format("degree {} x {} is outside 1..{}", entity->UDegree(), entity->VDegree(), highest));
  }
  if (entity->ControlPointsList().IsNull()) source.fail("control points are missing");
  const int points_u = entity->ControlPointsList()->ColLength();
  const int points_v = entity->ControlPointsList()->RowLength();
  const KnotTables tables = read_knots(*entity, points_u, points_v, source);
  NurbsSurface surface;
  surface.name = name;
  surface.u = make_direction(entity->UDegree(), points_u, tables.u, 'u', source);
  surface.v = make_direction(entity->VDegree(), points_v, tables.v, 'v', source);
  read_net(*entity, mm, surface, source);
  return surface;
}

}  // namespace bladefit
