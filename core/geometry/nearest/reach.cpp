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

bool nearest_by_reach(const Surface& surface, const SurfacePlace& foot, const Vec3& offset, const Vec3& cross) {
  const ImageSpan& span = surface.span(foot.span);
  const auto reach = static_cast<double>(span.reach[offset.dot(cross) < 0.0 ? 1 : 0]);
  if (!(offset.squaredNorm() < reach * reach)) return false;
  const SpanDomain d = surface.domain(foot.span);
  return well_inside(foot.u, d.u_min, d.u_max, span.inset[kLowU], span.inset[kHighU]) &&
         well_inside(foot.v, d.v_min, d.v_max, span.inset[kLowV], span.inset[kHighV]);
}

ReachProof proof_by_reach(const Surface& surface, const Projection& foot) {
  const Vec3 cross = foot.at.s_u.cross(foot.at.s_v);
  if (!nearest_by_reach(surface, foot.place, foot.offset, cross)) return {};
  const ImageSpan& span = surface.span(foot.place.span);
  const double square = foot.distance_squared(), distance = std::sqrt(square);
  const auto reach = static_cast<double>(span.reach[foot.offset.dot(cross) < 0.0 ? 1 : 0]);
  const auto apart = static_cast<double>(span.apart);
  return {true, std::sqrt(apart * apart * (1.0 - distance / reach) + square) - distance};
}

}  // namespace bladefit
