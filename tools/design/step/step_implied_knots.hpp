#pragma once
#include <StepShape_FaceSurface.hxx>

namespace bladefit {

/// Gives the surface of a face the knots that its entity implies (Bezier, uniform and quasi-uniform surfaces, ISO
/// 10303-42): OpenCASCADE makes faces only of surfaces whose knots are written. Others are left as they are. The
/// surface must be one in which spline_fault() finds nothing.
void write_implied_knots(StepShape_FaceSurface& face);

}  // namespace bladefit
