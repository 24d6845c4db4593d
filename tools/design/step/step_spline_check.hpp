#pragma once
#include <StepGeom_BSplineSurface.hxx>
#include <TColStd_HArray2OfReal.hxx>

#include <string>

namespace bladefit {

/// What is wrong with a B-spline surface of a STEP file: degree, number, order or multiplicity of knots, weights,
/// control points; one clause. Empty where nothing is. OpenCASCADE leaves such a surface out without a word, or stops.
[[nodiscard]] std::string spline_fault(const StepGeom_BSplineSurface& surface);

/// The weights of a rational surface; null for a polynomial one.
[[nodiscard]] Handle(TColStd_HArray2OfReal) weights_of(const StepGeom_BSplineSurface& surface);

}  // namespace bladefit
