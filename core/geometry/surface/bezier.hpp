#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "core/geometry/surface/design_image.hpp"

namespace bladefit {

/// Homogeneous point (w x, w y, w z, w).
using Homogeneous = Eigen::Array<double, 4, 1, Eigen::DontAlign>;

inline constexpr std::size_t kMaxOrder = kMaxDegree + 1;

/// Control net held on the stack, row by row in u.
struct BezierNet {
  std::uint32_t degree_u = 0, degree_v = 0;
  std::array<Homogeneous, kMaxOrder * kMaxOrder> points;
  [[nodiscard]] Homogeneous& at(std::uint32_t i, std::uint32_t j) { return points[i * (degree_v + 1) + j]; }
  [[nodiscard]] const Homogeneous& at(std::uint32_t i, std::uint32_t j) const { return points[i * (degree_v + 1) + j]; }
};

/// Rectangle of local parameters inside one span.
struct LocalRect {
  double s_min = 0, s_max = 1, t_min = 0, t_max = 1;
};

[[nodiscard]] inline LocalRect rect_of(const ImageLeaf& leaf) {
  return {static_cast<double>(leaf.s_min), static_cast<double>(leaf.s_max), static_cast<double>(leaf.t_min),
          static_cast<double>(leaf.t_max)};
}

/// Leaves of the net of a span that of the part over `rect`, by two de Casteljau cuts in each direction.
void restrict_net(const LocalRect& rect, BezierNet& net);

}  // namespace bladefit
