#include "tools/drawing/measured_radii.hpp"

#include <algorithm>
#include <array>

namespace bladefit {
namespace {

constexpr double kGap = 0.006, kWidest = 0.04;  ///< shares of R: between clusters, and across one
constexpr std::size_t kLeastPoints = 3;
constexpr double kLeastShare = 0.9;  ///< of the points, that clusters must hold
constexpr std::array<double, 13> kNavalRatios = {0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95, 0.975, 0.99};

std::vector<double> naval_radii(double least, double most, double tip_radius) {
  std::vector<double> radii;
  for (const double ratio : kNavalRatios) {
    const double radius = ratio * tip_radius;
    if (least - kWidest * tip_radius <= radius && radius <= most + kGap * tip_radius) radii.push_back(radius);
  }
  return radii;
}

}  // namespace

std::vector<double> measured_radii(std::vector<double> radii, double tip_radius) {
  if (radii.empty() || !(tip_radius > 0)) return {};
  std::ranges::sort(radii);
  std::vector<double> middles;
  std::size_t held = 0;
  for (std::size_t begin = 0, k = 1; k <= radii.size(); ++k) {
    if (k < radii.size() && radii[k] - radii[k - 1] <= kGap * tip_radius) continue;
    const std::size_t count = k - begin;
    if (count >= kLeastPoints && radii[k - 1] - radii[begin] <= kWidest * tip_radius) {
      middles.push_back(radii[begin + count / 2]);
      held += count;
    }
    begin = k;
  }
  const bool clustered = !middles.empty() && middles.size() <= kMostSections &&
                         static_cast<double>(held) >= kLeastShare * static_cast<double>(radii.size());
  return clustered ? middles : naval_radii(radii.front(), radii.back(), tip_radius);
}

}  // namespace bladefit
