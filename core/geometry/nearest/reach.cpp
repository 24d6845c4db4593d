#include "core/geometry/nearest/reach.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace bladefit {
namespace {

/// [spans]
constexpr double kAtSide = 1e-6;

bool well_inside(double x, double low, double high, std::uint8_t inset_low, std::uint8_t inset_high) {
  const double width = high - low;
  return x - low > (kAtSide + kInsetUnit * inset_low) * width && high - x > (kAtSide + kInsetUnit * inset_high) * width;
}

}  // namespace

ReachProof proof_by_reach(const Surface& surface, const Projection& foot) {
  const ImageSpan& span = surface.span(foot.place.span);
  const double distance = std::sqrt(foot.distance_squared());
  const bool other_side = foot.offset.dot(foot.at.s_u.cross(foot.at.s_v)) < 0.0;
  const auto reach = static_cast<double>(span.reach[other_side ? 1 : 0]);
  if (!(distance < reach)) return {};
  const SpanDomain d = surface.domain(foot.place.span);
  if (!well_inside(foot.place.u, d.u_min, d.u_max, span.inset[kLowU], span.inset[kHighU]) ||
      !well_inside(foot.place.v, d.v_min, d.v_max, span.inset[kLowV], span.inset[kHighV]))
    return {};
  const auto apart = static_cast<double>(span.apart);
  return {true, std::sqrt(apart * apart * (1.0 - distance / reach) + distance * distance) - distance};
}

}  // namespace bladefit
