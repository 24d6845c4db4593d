#pragma once
#include <string>
#include <vector>

#include "tools/design/iges/iges_parameters.hpp"

namespace bladefit {

/// Throws ToolError where a surface, boundary, curve, solid, group or matrix refers to an entity that is not there, or,
/// over whatever others, to itself. `parameters[k]` belong to `entities[k]`.
void check_iges_references(const std::vector<IgesEntity>& entities, const std::vector<IgesParameters>& parameters,
                           const std::string& file);

}  // namespace bladefit
