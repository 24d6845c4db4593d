#pragma once
#include <StepGeom_BSplineSurface.hxx>

#include <string>

#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// A B-spline surface of a STEP file, with explicit knots or with those that the standard gives to Bezier, uniform and
/// quasi-uniform surfaces (ISO 10303-42, 4.5.48 to 4.5.52). `name` is used in messages; `mm` is the file's unit.
/// Throws ToolError for a damaged or inconsistent entity. The surface is not otherwise checked.
NurbsSurface read_step_surface(const Handle(StepGeom_BSplineSurface) & entity, const std::string& name, double mm,
                               const std::string& file);

}  // namespace bladefit
