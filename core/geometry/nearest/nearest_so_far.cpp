#include "core/geometry/nearest/nearest_so_far.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

/// Answers are proven to within this [half diagonals].
constexpr double kSlack = 1e-10;
/// Where a runner-up is near, so may be a centre of curvature, about which minima are born: the two are relied on for
/// this share of the margin only.
constexpr double kShareOfTwo = 0.25;

}  // namespace

NearestSoFar::NearestSoFar(const Surface& surface, const ProjectionQuery& query)
    : surface_(surface),
      approach_(query.approach),
      margin_(query.margin),
      slack_(kSlack * surface.half_diagonal()),
      directed_(query.approach.squaredNorm() > 0.5) {}

void NearestSoFar::consider(const Projection& candidate) {
  if (candidate.outside) return;
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
      if (facing < kAlmostFacing * outward.norm()) note_runner_up(candidate, distance);
      return;
    }
  }
  const bool known = found_ && same(candidate.at.s, nearest_.at.s);
  if (found_ && distance >= distance_) {
    if (!known) note_runner_up(candidate, distance);
    return;
  }
  if (found_ && !known) note_runner_up(nearest_, distance_);
  nearest_ = candidate;
  distance_ = distance;
  found_ = true;
}

void NearestSoFar::consider_possible(const Projection& place, double least) {
  if (found_ && same(place.at.s, nearest_.at.s)) return;
  note_runner_up(place, least);
  third_distance_ = std::min(third_distance_, least);
}

void NearestSoFar::note_runner_up(const Projection& candidate, double distance) {
  const bool known = runner_up_distance_ < kNowhere && same(candidate.at.s, runner_up_);
  // One on a trim loop cannot be tracked: what is known about it is known about the third as well.
  if (candidate.on_trim()) third_distance_ = std::min(third_distance_, distance);
  if (distance >= runner_up_distance_) {
    if (!known) third_distance_ = std::min(third_distance_, distance);
    return;
  }
  if (!known) third_distance_ = runner_up_distance_;
  runner_up_distance_ = distance;
  runner_up_ = candidate.at.s;
  runner_up_place_ = candidate.place;
}

bool NearestSoFar::same(const Vec3& a, const Vec3& b) const {
  return (a - b).norm() <= kSameFoot * surface_.half_diagonal();
}

RunnerUp nothing_within(double margin) { return {margin, kShareOfTwo * margin, {}}; }

GlobalProjection NearestSoFar::result(bool exhausted, std::uint32_t pieces) const {
  GlobalProjection out;
  out.nearest = !found_ && has_resort_ ? resort_ : nearest_;
  out.proven = found_ && !exhausted;
  // A foot on a trim loop is searched each time.
  if (out.proven && !out.nearest.on_trim()) {
    out.runner_up.margin = std::max(0.0, std::min(runner_up_distance_ - distance_, margin_));
    out.runner_up.margin_to_third = std::max(0.0, std::min(third_distance_ - distance_, kShareOfTwo * margin_));
    out.runner_up.place = runner_up_place_;
  }
  out.pieces = pieces;
  out.exhausted = exhausted;
  return out;
}

}  // namespace bladefit
