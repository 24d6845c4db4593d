#include "core/geometry/nearest_so_far.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

/// Answers are proven to within this [half diagonals].
constexpr double kSlack = 1e-10;
/// Local minima this near to each other are one [half diagonals].
constexpr double kSameFoot = 1e-7;

}  // namespace

NearestSoFar::NearestSoFar(const Surface& surface, const ProjectionQuery& query)
    : surface_(surface),
      approach_(query.approach),
      margin_(query.margin),
      slack_(kSlack * surface.half_diagonal()),
      directed_(query.approach.squaredNorm() > 0.5) {}

void NearestSoFar::consider(const Projection& candidate) {
  if (!candidate.converged) {
    // Where no local minimum can be told, at a centre of curvature, the nearest place seen is the answer.
    if (!has_resort_ || candidate.distance_squared() < resort_.distance_squared()) resort_ = candidate;
    has_resort_ = true;
    return;
  }
  const double distance = std::sqrt(candidate.distance_squared());
  if (directed_) {
    const Vec3 outward = surface_.outward(candidate.place, candidate.at);
    const double facing = outward.dot(approach_);
    if (facing >= 0.0) {
      if (facing < kAlmostFacing * outward.norm()) rival_ = std::min(rival_, distance);
      return;
    }
  }
  const bool same = found_ && (candidate.at.s - nearest_.at.s).norm() <= kSameFoot * surface_.half_diagonal();
  if (found_ && distance >= distance_) {
    if (!same) rival_ = std::min(rival_, distance);
    return;
  }
  if (found_ && !same) rival_ = distance_;
  nearest_ = candidate;
  distance_ = distance;
  found_ = true;
}

GlobalProjection NearestSoFar::result(bool exhausted, std::uint32_t pieces) const {
  GlobalProjection out;
  out.nearest = !found_ && has_resort_ ? resort_ : nearest_;
  out.proven = found_ && !exhausted;
  out.lead = out.proven ? std::max(0.0, std::min(rival_ - distance_, margin_)) : 0.0;
  out.pieces = pieces;
  out.exhausted = exhausted;
  return out;
}

}  // namespace bladefit
