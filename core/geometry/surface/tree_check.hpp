#pragma once
#include "core/geometry/surface/design_image.hpp"

namespace bladefit {

/// The tree is in depth-first order and no deeper than kMaxTreeDepth, its boxes are nested, and every leaf and
/// every run of trims stands in it once, inside its box. For an image whose other arrays are valid. Cost: linear in the
/// size.
[[nodiscard]] bool tree_valid(const DesignImage& image);

}  // namespace bladefit
