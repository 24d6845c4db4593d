#include "tools/batch/edge_zone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace bladefit {
namespace {

/// Steps over a patch in one direction, and lines across it on which the surface is looked at.
constexpr std::size_t kSteps = 120;
constexpr std::array<double, 5> kLines = {0.2, 0.35, 0.5, 0.65, 0.8};
/// A strip that bends less than the first is no edge; one that bends more than the second is one [degrees].
constexpr double kFlat = 60, kEdge = 120;

/// How far the normal turns from the beginning of a patch to each step along one parameter, as on the line where it
/// turns least but one [degrees].
class Turning {
 public:
  Turning(const Surface& surface, std::uint32_t patch, bool along_u) {
    for (const double line : kLines) {
      std::vector<double> to(kSteps + 1, 0.0);
      Vec3 before = Vec3::Zero();
      for (std::size_t k = 0; k <= kSteps; ++k) {
        const double t = static_cast<double>(k) / kSteps;
        const SurfacePlace place = along_u ? surface.place_at(patch, t, line) : surface.place_at(patch, line, t);
        const Vec3 normal = surface.normal(place, surface.evaluate(place));
        if (k > 0) to[k] = to[k - 1] + std::acos(std::clamp(normal.dot(before), -1.0, 1.0)) * 180.0 / std::numbers::pi;
        before = normal;
      }
      lines_.push_back(to);
    }
  }

  /// Between two parameters.
  [[nodiscard]] double between(double low, double high) const {
    std::vector<double> turns;
    for (const std::vector<double>& to : lines_) turns.push_back(at(to, high) - at(to, low));
    std::sort(turns.begin(), turns.end());
    return turns[1];
  }

 private:
  static double at(const std::vector<double>& to, double t) {
    const double step = std::clamp(t, 0.0, 1.0) * kSteps;
    const auto k = std::min(static_cast<std::size_t>(step), kSteps - 1);
    return to[k] + (step - static_cast<double>(k)) * (to[k + 1] - to[k]);
  }

  std::vector<std::vector<double>> lines_;
};

struct Strip {
  bool along_u = true;
  double middle = 0, turn = 0;
};

/// The strip of this width that bends most.
Strip sharpest(const Turning& turning, bool along_u, double width) {
  Strip best{along_u, 0.0, -1.0};
  for (std::size_t k = 0; k <= kSteps; ++k) {
    const double middle = static_cast<double>(k) / kSteps;
    const double low = std::max(0.0, middle - width / 2), high = std::min(1.0, middle + width / 2);
    const double turn = turning.between(low, high);
    if (turn > best.turn) best = {along_u, middle, turn};
  }
  return best;
}

}  // namespace

std::string zone_warning(const Surface& surface, const ParameterBox& box) {
  const bool along_u = box.u_max - box.u_min < box.v_max - box.v_min;
  const double low = along_u ? box.u_min : box.v_min, high = along_u ? box.u_max : box.v_max;
  const Turning turning_u(surface, box.patch, true), turning_v(surface, box.patch, false);
  const double own = (along_u ? turning_u : turning_v).between(low, high);
  if (own > kFlat) return "";
  const Strip u = sharpest(turning_u, true, high - low), v = sharpest(turning_v, false, high - low);
  const Strip& most = u.turn > v.turn ? u : v;
  if (most.turn < kEdge) return "";
  return fmt::format(
      "warning: the zone {}:{:g}:{:g} of patch {} is not where the blade's edge is: the surface turns by {:.0f} "
      "degrees "
      "across it, and by {:.0f} degrees about {} {:.2f}; check --leading-edge\n",
      along_u ? "u" : "v", low, high, box.patch, own, most.turn, most.along_u ? "u" : "v", most.middle);
}

}  // namespace bladefit
