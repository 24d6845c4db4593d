#pragma once
#include "core/geometry/surface/design_image.hpp"

namespace bladefit {

/// Trim loops are closed, each piece lies in its span and begins where it says, runs tile them, and slabs hold all
/// pieces that reach into them. For an image whose patches and spans are valid. Cost: linear in the size, but for
/// logarithms.
[[nodiscard]] bool trims_valid(const DesignImage& image);

}  // namespace bladefit
