#include "core/localizer.hpp"

namespace bladefit {

/// Tracks stored points at the present pose, and takes their rows, `x` away from the reference of the sums they are
/// for. Cost: some 60 ns a point; nothing where the processor has no lanes.
void Localizer::track(LaneBlock& block, std::span<const std::uint32_t> indices, const Vec6& x) const {
  for (std::uint32_t lane = 0; lane < indices.size(); ++lane) {
    const StoredPoint& point = points_[indices[lane]];
    block.index[lane] = indices[lane];
    block.feet.enter(surface_, apply(pose_, point.position), {point.span, point.foot.u, point.foot.v});
  }
  block.feet.find(surface_);
  const LaneWalk* walk = block.feet.walk();
  if (walk == nullptr) return;
  const LaneFrame frame{{frame_.pivot[0], frame_.pivot[1], frame_.pivot[2]},
                        frame_.length,
                        {x[0], x[1], x[2], x[3], x[4], x[5]},
                        static_cast<double>(surface_.image().header().outward),
                        config_.probe_radius_mm};
  take_rows(*walk, frame, block.rows);
}

/// The same as of the point by itself, to the last bit.
Measurement Localizer::measure(const LaneBlock& block, std::uint32_t lane, Search search) const {
  const StoredPoint& point = points_[block.index[lane]];
  if (!block.feet.found(lane) || !block.rows.regular[lane]) return measure(point, pose_, search);
  Measurement m;
  m.r = block.feet.point(lane);
  m.projection = block.feet.projection(lane);
  examine(point, pose_, search, m);
  const SurfacePlace &own = block.feet.place(lane), &found = m.projection.place;
  if (found.span != own.span || found.u != own.u || found.v != own.v) {
    m.foot = foot_of(surface_, m.projection, config_.probe_radius_mm);
    return m;
  }
  m.foot = {surface_.span(own.span).patch,
            own.u,
            own.v,
            m.projection.at.s,
            lane_of(block.rows.normal, lane),
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
