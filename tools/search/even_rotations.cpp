#include "tools/search/even_rotations.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace bladefit {

std::vector<Mat3> even_rotations(std::size_t count) {
  // Solutions of x^4 = x + 4 and of x^2 = 2, with which the two spirals never fall into step.
  constexpr double kPsi = 1.533751168755204288118041, kPhi = std::numbers::sqrt2;
  std::vector<Mat3> rotations;
  rotations.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double s = static_cast<double>(k) + 0.5, share = s / static_cast<double>(count);
    const double a = 2.0 * std::numbers::pi * s / kPhi, b = 2.0 * std::numbers::pi * s / kPsi;
    const double low = std::sqrt(share), high = std::sqrt(1.0 - share);
    const Eigen::Quaterniond q(high * std::cos(b), low * std::sin(a), low * std::cos(a), high * std::sin(b));
    rotations.emplace_back(q.toRotationMatrix());
  }
  return rotations;
}

}  // namespace bladefit
