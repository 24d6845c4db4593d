#pragma once
#include <string>

#include "core/geometry/surface/surface.hpp"
#include "core/inspection/tolerance_map.hpp"

namespace bladefit {

/// A warning where a leading-edge box lies where the surface hardly bends, while elsewhere on its patch it turns back
/// within as narrow a strip: then the box names the wrong parameter, or the wrong part of it. Empty where the box may
/// be right: a joint of two patches bends nowhere. Cost: some thousand evaluations.
[[nodiscard]] std::string zone_warning(const Surface& surface, const ParameterBox& box);

}  // namespace bladefit
