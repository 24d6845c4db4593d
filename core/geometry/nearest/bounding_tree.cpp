#include "core/geometry/nearest/bounding_tree.hpp"

namespace bladefit {
namespace {

/// Single precision: coordinates are off by this share of their size, squares by this share of themselves.
constexpr double kCoordinateRounding = 4e-7, kSquareRounding = 2e-6;

}  // namespace

BoxDistances::BoxDistances(const Vec3& arm)
    : arm_(arm.array().cast<float>()), rounding_(kCoordinateRounding * arm.cwiseAbs().maxCoeff()) {}

float BoxDistances::threshold(double limit) const {
  const double least = limit + rounding_;
  return static_cast<float>(least * least * (1.0 + kSquareRounding));
}

}  // namespace bladefit
