#include "core/localizer/foot_finder.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/geometry/nearest/held_sides.hpp"
#include "core/geometry/nearest/reach.hpp"

namespace bladefit {

StoredPoint FootFinder::new_point(const ProbePoint& point, const SurfacePlace& start) const {
  StoredPoint made;
  made.position = to_vec3(point.position);
  if (problem_.config.use_approach) made.approach = to_vec3(point.approach);
  made.sequence = point.sequence;
  made.weight = point.weight;
  made.span = start.span;
  made.foot.u = start.u;
  made.foot.v = start.v;
  made.outside_window = outside_window(made);
  return made;
}

bool FootFinder::outside_window(const StoredPoint& point) const {
  const LocalizerConfig& config = problem_.config;
  if (config.window_low <= 0.0 && config.window_high >= 1.0) return false;
  const Foot foot = find(point, config.start, Search::always).foot;
  const auto outside = [&config](double t) { return t < config.window_low || t > config.window_high; };
  return outside(foot.u) || outside(foot.v);
}

Measurement FootFinder::find_from(const FootStart& start, const StoredPoint& point, const Pose& pose) const {
  Measurement m;
  m.r = apply(pose, point.position);
  m.alone = project_local(problem_.surface, m.r, start.place);
  examine(point, pose, start.search, m);
  m.place = m.alone.place;
  m.foot = foot_of(problem_.surface, m.alone, problem_.config.probe_radius_mm);
  return m;
}

/// Tracks the points that were entered. Cost: some 60 ns a point; nothing where the processor has no wide registers.
void FootFinder::track(const Vec6& x, LaneBlock& block) const {
  block.feet.find(problem_.surface);
  const LaneWalk* walk = block.feet.walk();
  if (walk == nullptr) return;
  const MotionFrame& frame = problem_.frame;
  LaneFrame lane_frame{{frame.pivot[0], frame.pivot[1], frame.pivot[2]},
                       frame.length,
                       {x[0], x[1], x[2], x[3], x[4], x[5]},
                       problem_.config.probe_radius_mm,
                       {}};
  for (std::uint32_t lane = 0; lane < kLanes; ++lane)
    lane_frame.outward[lane] = problem_.surface.side_of(block.feet.place(lane).span);
  take_rows(*walk, lane_frame, block.rows);
}

/// What find_from() gives, to the last bit, from the lane in which the point was tracked.
Measurement FootFinder::find_tracked(const FootStart& start, const StoredPoint& point, const Pose& pose,
                                     const LaneBlock& block, std::uint32_t lane) const {
  Measurement m;
  m.r = block.feet.point(lane);
  m.alone = block.feet.projection(lane);
  examine(point, pose, start.search, m);
  m.place = m.alone.place;
  const SurfacePlace& own = block.feet.place(lane);
  if (m.place.span == own.span && m.place.u == own.u && m.place.v == own.v) {
    m.block = &block;
    m.lane = lane;
    LaneFoot{&block, lane, false}.write_to(m.foot, problem_.surface);
  } else {
    m.foot = foot_of(problem_.surface, m.alone, problem_.config.probe_radius_mm);
  }
  return m;
}

/// Whether examine() would keep the foot in a lane without a search; with what it would prove.
bool FootFinder::stays_in_lane(const FootStart& start, const StoredPoint& point, const Pose& pose,
                               LaneFoot& foot) const {
  if (start.search == Search::keep) return true;
  const LaneProjections& feet = foot.block->feet;
  if (left_trim(point)) return false;
  if (may_be_overtaken(point, start.search, feet.point(foot.lane))) return false;
  const bool directed = point.approach.squaredNorm() > 0.0, always = start.search == Search::always;
  if (!directed && !always) return true;
  const Vec3 cross = feet.cross(foot.lane);
  const double side = problem_.surface.side_of(foot.place().span);
  if (directed && !faces_probe(side * cross, pose.rotation * point.approach)) return false;
  foot.proven_nearest = always && nearest_by_reach(problem_.surface, foot.place(), feet.offset(foot.lane), cross);
  return foot.proven_nearest || !always;
}

Measurement FootFinder::measured(const LaneFoot& foot) const {
  Measurement m;
  m.r = foot.block->feet.point(foot.lane);
  m.place = foot.place();
  m.block = foot.block;
  m.lane = foot.lane;
  m.ranked = foot.proven_nearest;
  foot.write_to(m.foot, problem_.surface);
  return m;
}

DistanceRow FootFinder::row(const Measurement& m, const Vec6& x) const {
  if (m.block == nullptr) return distance_row(m.alone, m.foot, m.r, x, problem_.frame);
  DistanceRow row;
  row.distance = m.foot.distance;
  for (int k = 0; k < 6; ++k) row.gradient[k] = m.block->rows.gradient[k][m.lane];
  int entry = 0;
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i <= j; ++i, ++entry) row.bend(i, j) = row.bend(j, i) = m.block->rows.bend[entry][m.lane];
  }
  return row;
}

/// Whether the projection that a point was tracked to is its nearest: where that is in doubt, the design is searched.
void FootFinder::examine(const StoredPoint& point, const Pose& pose, Search search, Measurement& m) const {
  const Surface& surface = problem_.surface;
  const bool tracked = m.alone.converged && !m.alone.outside;
  if (search == Search::keep && tracked && !falls_over_seam(surface, m.alone)) return;
  ProjectionQuery query{m.r, pose.rotation * point.approach};
  const bool doubtful = !tracked || left_trim(point) || m.alone.fixed_u || m.alone.fixed_v || m.alone.at_pole ||
                        !faces_probe(surface, m.alone, query.approach);
  const bool known = !doubtful && (!may_be_overtaken(point, search, m.r) || weigh_runner_up(point, query, m));
  if (known && search != Search::always) return;
  if (search == Search::past_margin) query.margin = tuning::kSearchMargin * problem_.frame.length;
  if (!doubtful && proven_without_search(query.margin, m)) return;
  const GlobalProjection global = project_global(surface, query, &m.alone);
  // Newton's method does not end on a crease of the surface: there it is the foot of before that is found again.
  const Vec3& before = tracked ? m.alone.at.s : point.foot.point;
  m.changed = !same_foot(global.nearest.at.s, before);
  m.alone = global.nearest;
  m.searched = m.ranked = true;
  m.runner_up = global.runner_up;
  m.proven = global.proven;
}

/// Distances change by no more than the point moves, so within half its margin no local minimum that was there can have
/// come nearer than the tracked foot. A newborn one could: refine() ends with a proof of every foot.
bool FootFinder::may_be_overtaken(const StoredPoint& point, Search search, const Vec3& r) const {
  return search == Search::past_margin && 2.0 * (r - point.ranked_at).norm() >= point.runner_up.margin;
}

/// What a search would find, with its margin to other local minima, is told by the reach of the foot.
bool FootFinder::proven_without_search(double margin, Measurement& m) const {
  const ReachProof proof = proof_by_reach(problem_.surface, m.alone);
  if (!proof.nearest || (margin > 0.0 && proof.margin < tuning::kMarginByReach * margin)) return false;
  m.ranked = true;
  m.runner_up = nothing_within(margin);
  return true;
}

/// Its foot was at the end of a face with trim loops: these do not hold what is tracked from there.
bool FootFinder::left_trim(const StoredPoint& point) const {
  const Surface& surface = problem_.surface;
  return surface.has_trims() && point.foot.kind != FootKind::interior && surface.patch_of(point.span).slab_count > 0;
}

bool FootFinder::same_foot(const Vec3& a, const Vec3& b) const {
  return (a - b).norm() <= tuning::kSameFoot * problem_.frame.length;
}

/// Makes the nearer of the tracked foot and its tracked runner-up the projection, as long as no third can be nearer.
/// False where that is uncertain.
bool FootFinder::weigh_runner_up(const StoredPoint& point, const ProjectionQuery& query, Measurement& m) const {
  const double margin_to_third = point.runner_up.margin_to_third - 2.0 * (m.r - point.ranked_at).norm();
  if (!(margin_to_third > 0.0)) return false;
  const Projection other = project_local(problem_.surface, m.r, point.runner_up.place);
  if (!other.converged || other.outside) return false;
  double margin = other.offset.norm() - m.alone.offset.norm();
  SurfacePlace place = other.place;
  if (same_foot(other.at.s, m.alone.at.s)) {
    margin = margin_to_third;  // the two have become one
  } else if (margin < 0.0 && faces_probe(problem_.surface, other, query.approach)) {
    if (other.fixed_u || other.fixed_v || other.at_pole) return false;
    margin = -margin;
    place = m.alone.place;
    m.alone = other;
    m.changed = true;
  }
  m.ranked = true;
  m.runner_up = {std::clamp(margin, 0.0, margin_to_third), margin_to_third, place};
  return true;
}

}  // namespace bladefit
