#include "tools/design/step/step_implied_knots.hpp"

#include <StepGeom_BSplineSurfaceWithKnots.hxx>
#include <StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface.hxx>
#include <StepGeom_BezierSurface.hxx>
#include <StepGeom_BezierSurfaceAndRationalBSplineSurface.hxx>
#include <StepGeom_QuasiUniformSurface.hxx>
#include <StepGeom_QuasiUniformSurfaceAndRationalBSplineSurface.hxx>
#include <StepGeom_UniformSurface.hxx>
#include <StepGeom_UniformSurfaceAndRationalBSplineSurface.hxx>
#include <TColStd_HArray1OfInteger.hxx>
#include <TColStd_HArray1OfReal.hxx>

#include <optional>

#include "tools/design/step/step_spline_check.hpp"

namespace bladefit {
namespace {

enum class Form { bezier, quasi_uniform, uniform };

struct Knots {
  Handle(TColStd_HArray1OfReal) values;
  Handle(TColStd_HArray1OfInteger) multiplicities;
};

template <class Plain, class Rational>
bool is_either(const StepGeom_BSplineSurface& surface) {
  return surface.IsKind(STANDARD_TYPE(Plain)) || surface.IsKind(STANDARD_TYPE(Rational));
}

std::optional<Form> form_of(const StepGeom_BSplineSurface& surface) {
  if (is_either<StepGeom_BezierSurface, StepGeom_BezierSurfaceAndRationalBSplineSurface>(surface)) return Form::bezier;
  if (is_either<StepGeom_QuasiUniformSurface, StepGeom_QuasiUniformSurfaceAndRationalBSplineSurface>(surface))
    return Form::quasi_uniform;
  if (is_either<StepGeom_UniformSurface, StepGeom_UniformSurfaceAndRationalBSplineSurface>(surface))
    return Form::uniform;
  return std::nullopt;
}

/// Whole numbers as knots: Bezier pieces from 0 on, quasi-uniform ones from 0 on with full ends, uniform ones from
/// minus the degree on.
Knots implied_knots(Form form, int degree, int points) {
  const int first = form == Form::uniform ? -degree : 0;
  const int count = form == Form::bezier          ? (points - 1) / degree + 1
                    : form == Form::quasi_uniform ? points - degree + 1
                                                  : points + degree + 1;
  Knots knots{new TColStd_HArray1OfReal(1, count), new TColStd_HArray1OfInteger(1, count)};
  for (int k = 1; k <= count; ++k) {
    const bool end = k == 1 || k == count;
    knots.values->SetValue(k, first + k - 1);
    knots.multiplicities->SetValue(k, form == Form::uniform ? 1 : end ? degree + 1 : form == Form::bezier ? degree : 1);
  }
  return knots;
}

Handle(StepGeom_BSplineSurface) with_knots(const StepGeom_BSplineSurface& surface, Form form) {
  const Handle(StepGeom_HArray2OfCartesianPoint) points = surface.ControlPointsList();
  const Knots u = implied_knots(form, surface.UDegree(), points->ColLength()),
              v = implied_knots(form, surface.VDegree(), points->RowLength());
  if (const Handle(TColStd_HArray2OfReal) weights = weights_of(surface); !weights.IsNull()) {
    const Handle(StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface) rational =
        new StepGeom_BSplineSurfaceWithKnotsAndRationalBSplineSurface;
    rational->Init(surface.Name(), surface.UDegree(), surface.VDegree(), points, surface.SurfaceForm(),
                   surface.UClosed(), surface.VClosed(), surface.SelfIntersect(), u.multiplicities, v.multiplicities,
                   u.values, v.values, StepGeom_ktUnspecified, weights);
    return rational.get();
  }
  const Handle(StepGeom_BSplineSurfaceWithKnots) plain = new StepGeom_BSplineSurfaceWithKnots;
  plain->Init(surface.Name(), surface.UDegree(), surface.VDegree(), points, surface.SurfaceForm(), surface.UClosed(),
              surface.VClosed(), surface.SelfIntersect(), u.multiplicities, v.multiplicities, u.values, v.values,
              StepGeom_ktUnspecified);
  return plain.get();
}

}  // namespace

void write_implied_knots(StepShape_FaceSurface& face) {
  const auto surface = Handle(StepGeom_BSplineSurface)::DownCast(face.FaceGeometry());
  if (surface.IsNull()) return;
  if (const std::optional<Form> form = form_of(*surface)) face.SetFaceGeometry(with_knots(*surface, *form));
}

}  // namespace bladefit
