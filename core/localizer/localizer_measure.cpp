#include <algorithm>
#include <cmath>

#include "core/localizer.hpp"

namespace bladefit {
namespace {

/// Rivals of a foot are sought up to this much farther [half diagonals], so that it can be tracked for half as long.
constexpr double kSearchMargin = 2e-3;
/// Feet this near to each other are one [half diagonals].
constexpr double kSameFoot = 1e-8;
/// A point may be drawn over an edge where it counts, and back where it does not. Left out so often, it stays out.
constexpr std::uint8_t kMostExits = 4;

}  // namespace

Measurement Localizer::measure(const StoredPoint& point, const Pose& pose, Search search) const {
  Measurement m;
  m.r = apply(pose, point.position);
  m.projection = project_local(surface_, m.r, {point.span, point.foot.u, point.foot.v});
  examine(point, pose, search, m);
  m.foot = foot_of(surface_, m.projection, config_.probe_radius_mm);
  return m;
}

/// Whether the projection that a point was tracked to is its nearest: where that is in doubt, the design is searched.
void Localizer::examine(const StoredPoint& point, const Pose& pose, Search search, Measurement& m) const {
  ProjectionQuery query{m.r, pose.rotation * point.approach};
  const bool doubtful = !m.projection.converged || m.projection.fixed_u || m.projection.fixed_v ||
                        !faces_probe(surface_, m.projection, query.approach);
  // Distances change by no more than the point moves, so within half its lead no rival that was there can have come
  // nearer than the tracked foot. A newborn one could: refine() ends with a search of every foot.
  const bool far = search == Search::past_lead && 2.0 * (m.r - point.ranked_at).norm() >= point.rivals.lead;
  const bool known = !doubtful && (!far || weigh_rival(point, query, m));
  if (!known || search == Search::always) {
    if (search == Search::past_lead) query.margin = kSearchMargin * frame_.length;
    const GlobalProjection global = project_global(surface_, query, &m.projection);
    // Newton's method does not end on a crease of the surface: there it is the foot of before that is found again.
    const Vec3& before = m.projection.converged ? m.projection.at.s : point.foot.point;
    m.changed = !same_foot(global.nearest.at.s, before);
    m.projection = global.nearest;
    m.searched = m.ranked = true;
    m.rivals = global.rivals;
    m.proven = global.proven;
  }
}

bool Localizer::same_foot(const Vec3& a, const Vec3& b) const { return (a - b).norm() <= kSameFoot * frame_.length; }

/// Makes the nearer of the tracked foot and its tracked rival the projection, as long as no third can be nearer. False
/// where that cannot be told.
bool Localizer::weigh_rival(const StoredPoint& point, const ProjectionQuery& query, Measurement& m) const {
  const double lead_of_two = point.rivals.lead_of_two - 2.0 * (m.r - point.ranked_at).norm();
  if (!(lead_of_two > 0.0)) return false;
  const Projection rival = project_local(surface_, m.r, point.rivals.place);
  if (!rival.converged) return false;
  double lead = rival.offset.norm() - m.projection.offset.norm();
  SurfacePlace place = rival.place;
  if (same_foot(rival.at.s, m.projection.at.s)) {
    lead = lead_of_two;  // the two have become one
  } else if (lead < 0.0 && faces_probe(surface_, rival, query.approach)) {
    if (rival.fixed_u || rival.fixed_v) return false;
    lead = -lead;
    place = m.projection.place;
    m.projection = rival;
    m.changed = true;
  }
  m.ranked = true;
  m.rivals = {std::clamp(lead, 0.0, lead_of_two), lead_of_two, place};
  return true;
}

bool Localizer::outside_window(const StoredPoint& point) const {
  if (config_.window_low <= 0.0 && config_.window_high >= 1.0) return false;
  const Foot foot = measure(point, config_.start, Search::always).foot;
  const auto outside = [this](double t) { return t < config_.window_low || t > config_.window_high; };
  return outside(foot.u) || outside(foot.v);
}

bool Localizer::left_out(const StoredPoint& point, const Foot& foot) const {
  if (regions_held_) return point.held_out;
  return point.outside_window || (exits_count_ && point.exits >= kMostExits) ||
         (foot.kind != FootKind::interior && config_.edges == EdgePolicy::skip);
}

}  // namespace bladefit
