#include "core/geometry/newton_walk.hpp"
#include "core/localizer.hpp"

namespace bladefit {
namespace {

Vec3 vector_of(const LaneNumbers (&numbers)[3], std::uint32_t lane) {
  return {numbers[0][lane], numbers[1][lane], numbers[2][lane]};
}

/// Puts a point into a lane. False where its foot is not inside a bicubic span, which is all that lanes can do.
bool enter(const Surface& surface, const SurfacePlace& place, const Vec3& r, std::uint32_t lane, LaneBlock& block) {
  const ImagePatch& patch = surface.patch_of(place.span);
  const SpanDomain d = surface.domain(place.span);
  const bool inside = place.u >= d.u_min && place.u <= d.u_max && place.v >= d.v_min && place.v <= d.v_max;
  if (patch.degree_u != 3 || patch.degree_v != 3 || !inside) return false;
  LaneWalk& walk = block.walk;
  walk.taylor[lane] = surface.taylor(place.span);
  walk.per_u[lane] = 1.0 / (d.u_max - d.u_min);
  walk.per_v[lane] = 1.0 / (d.v_max - d.v_min);
  walk.x[lane] = (place.u - d.u_min) * walk.per_u[lane] - 0.5;
  walk.y[lane] = (place.v - d.v_min) * walk.per_v[lane] - 0.5;
  for (int k = 0; k < 3; ++k) walk.r[k][lane] = r[k];
  block.place[lane].span = place.span;
  return true;
}

/// What a lane holds that is of no interest.
void copy_lane(LaneWalk& walk, std::uint32_t from, std::uint32_t to) {
  walk.taylor[to] = walk.taylor[from];
  for (LaneNumbers* numbers : {&walk.per_u, &walk.per_v, &walk.x, &walk.y, &walk.r[0], &walk.r[1], &walk.r[2]})
    (*numbers)[to] = (*numbers)[from];
}

/// The foot of a lane, in the parameters of its patch.
void leave(const Surface& surface, std::uint32_t lane, LaneBlock& block) {
  SurfacePlace& place = block.place[lane];
  const SpanDomain d = surface.domain(place.span);
  place.u = d.u_min + (block.walk.x[lane] + 0.5) * (d.u_max - d.u_min);
  place.v = d.v_min + (block.walk.y[lane] + 0.5) * (d.v_max - d.v_min);
  place = clamped(place, ParameterLimits());
}

Projection projection_of(const LaneBlock& block, std::uint32_t lane) {
  const LaneWalk& walk = block.walk;
  Projection p;
  p.place = block.place[lane];
  p.at = {vector_of(walk.s, lane),    vector_of(walk.s_u, lane),  vector_of(walk.s_v, lane),
          vector_of(walk.s_uu, lane), vector_of(walk.s_uv, lane), vector_of(walk.s_vv, lane)};
  p.offset = vector_of(walk.offset, lane);
  p.converged = true;
  return p;
}

}  // namespace

/// Tracks stored points at the present pose, and takes their rows, `x` away from the reference of the sums they are
/// for. Cost: some 60 ns a point; nothing where the processor has no such lanes.
void Localizer::track(LaneBlock& block, std::span<const std::uint32_t> indices, const Vec6& x) const {
  std::uint32_t used = kLanes;
  for (std::uint32_t lane = 0; lane < indices.size(); ++lane) {
    const StoredPoint& point = points_[indices[lane]];
    block.index[lane] = indices[lane];
    const SurfacePlace start{point.span, point.foot.u, point.foot.v};
    block.tracked[lane] = lanes_ && enter(surface_, start, apply(pose_, point.position), lane, block);
    if (block.tracked[lane]) used = lane;
  }
  if (used == kLanes) return;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    if (!block.tracked[lane]) copy_lane(block.walk, used, lane);
  }
  block.walk.last_step = kLastStep * surface_.half_diagonal();
  block.walk.slack = kDistanceRounding * surface_.half_diagonal();
  walk_lanes(block.walk);
  LaneFrame frame{{frame_.pivot[0], frame_.pivot[1], frame_.pivot[2]},
                  frame_.length,
                  {x[0], x[1], x[2], x[3], x[4], x[5]},
                  static_cast<double>(surface_.image().header().outward),
                  config_.probe_radius_mm};
  take_rows(block.walk, frame, block.rows);
  for (std::uint32_t lane = 0; lane < indices.size(); ++lane) {
    block.tracked[lane] = block.tracked[lane] && block.walk.converged[lane] && block.rows.regular[lane];
    if (block.tracked[lane]) leave(surface_, lane, block);
  }
}

/// The same as of the point by itself, to the last bit.
Measurement Localizer::measure(const LaneBlock& block, std::uint32_t lane, Search search) const {
  const StoredPoint& point = points_[block.index[lane]];
  if (!block.tracked[lane]) return measure(point, pose_, search);
  Measurement m;
  m.r = vector_of(block.walk.r, lane);
  m.projection = projection_of(block, lane);
  examine(point, pose_, search, m);
  const SurfacePlace &own = block.place[lane], &found = m.projection.place;
  if (found.span != own.span || found.u != own.u || found.v != own.v) {
    m.foot = foot_of(surface_, m.projection, config_.probe_radius_mm);
    return m;
  }
  m.foot = {surface_.span(own.span).patch,
            own.u,
            own.v,
            m.projection.at.s,
            vector_of(block.rows.normal, lane),
            block.rows.distance[lane],
            FootKind::interior};
  m.block = &block;
  m.lane = lane;
  return m;
}

DistanceRow Localizer::row_of(const Measurement& m, const Vec6& x) const {
  if (m.block == nullptr) return distance_row(m.projection, m.foot, m.r, x, frame_);
  DistanceRow row;
  row.distance = m.foot.distance;
  for (int k = 0; k < 6; ++k) row.gradient[k] = m.block->rows.gradient[k][m.lane];
  int entry = 0;
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i <= j; ++i, ++entry) row.bend(i, j) = row.bend(j, i) = m.block->rows.bend[entry][m.lane];
  }
  return row;
}

}  // namespace bladefit
