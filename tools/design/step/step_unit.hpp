#pragma once
#include <StepData_StepModel.hxx>

#include <string>

#include "tools/design/nurbs/length_unit.hpp"

namespace bladefit {

/// The unit of length that the geometric contexts of a STEP file assign. Throws ToolError where there is none, one
/// that is not known, or two different ones.
LengthUnit read_step_unit(const StepData_StepModel& model, const std::string& file);

}  // namespace bladefit
