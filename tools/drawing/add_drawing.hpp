#pragma once
#include "core/geometry/surface/design_image.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// Fills the drawing of a result by the design that it was judged by. Points whose patch the design does not have keep
/// what is not known. Cost: some 300,000 evaluations of the surface, and one for each point.
void add_drawing(const DesignImage& design, Result& result);

}  // namespace bladefit
