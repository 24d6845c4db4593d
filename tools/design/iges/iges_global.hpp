#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "tools/design/iges/iges_parameters.hpp"
#include "tools/design/nurbs/length_unit.hpp"

namespace bladefit {

/// What the global section of an IGES file says about its numbers. Read from the text, since OpenCASCADE 7.6 turns
/// units that it does not know into inches.
struct IgesGlobal {
  IgesDelimiters delimiters;
  LengthUnit unit{1.0, "millimetre"};
  int unit_flag = 2;       ///< of `unit`, as in field 14
  double model_scale = 1;  ///< coordinates are real lengths times this
  std::string resolution;  ///< field 19: least distance of points that differ, in the unit of the file; may be empty
  std::vector<std::string> warnings;
};

/// Reads the records of the global section (72 columns each). Throws ToolError naming the field where the unit is
/// unknown or the scale is not above 0.
IgesGlobal read_iges_global(const std::vector<std::string_view>& records, const std::string& file);

}  // namespace bladefit
