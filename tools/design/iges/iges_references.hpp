#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "tools/design/iges/iges_parameters.hpp"

namespace bladefit {

/// Throws ToolError where a surface, boundary, curve, solid, group or matrix refers to an entity that is not there, or,
/// over whatever others, to itself. `parameters[k]` belong to `entities[k]`.
void check_iges_references(const std::vector<IgesEntity>& entities, const std::vector<IgesParameters>& parameters,
                           const std::string& file);

/// The entities that entity `index` is made of, over all steps, itself left out. For files that check_iges_references()
/// has passed. Costs as much as there are of them.
[[nodiscard]] std::vector<std::size_t> iges_parts(const std::vector<IgesEntity>& entities,
                                                  const std::vector<IgesParameters>& parameters, std::size_t index);

}  // namespace bladefit
