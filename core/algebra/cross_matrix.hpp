#pragma once
#include "core/algebra/matrix.hpp"

namespace bladefit {

/// The matrix of the cross product: cross_matrix(a) b = a x b.
[[nodiscard]] inline Mat3 cross_matrix(const Vec3& a) {
  Mat3 m;
  m << 0.0, -a[2], a[1], a[2], 0.0, -a[0], -a[1], a[0], 0.0;
  return m;
}

}  // namespace bladefit
