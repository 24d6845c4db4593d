#pragma once
#include <cstddef>

#include "core/geometry/surface/design_image.hpp"

namespace bladefit {

/// Those of ImageBounds: s, t, aa, ab, bb, across s, across t.
inline constexpr std::size_t kDerivatives = 7;

/// ImageBounds before they are rounded: see there.
struct LeafBounds {
  double middle[3];   ///< numbers of single precision, as `stretch`
  double axis[3][3];  ///< orthonormal
  double low[3], high[3];
  double stretch[3];
  double derivative[kDerivatives][3];
  double spread[kDerivatives][3];
  double self_low[kDerivatives], self_high[kDerivatives];
};

/// The number of single precision that is nearest.
[[nodiscard]] inline double in_single(double x) { return static_cast<double>(static_cast<float>(x)); }

/// Rounded so that what is bounded stays so: limits outwards, spreads upwards, and each widened by what the rounding of
/// the axes and of the derivatives in the middle adds.
[[nodiscard]] ImageBounds packed(const LeafBounds& bounds);

}  // namespace bladefit
