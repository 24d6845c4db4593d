#include "core/geometry/nearest/lane_projection.hpp"

#include <Eigen/Geometry>

#include "core/geometry/nearest/newton_walk.hpp"
#include "core/geometry/surface/trim.hpp"

namespace bladefit {

void LaneProjections::enter(const Surface& surface, const Vec3& r, const SurfacePlace& start) {
  const std::uint32_t lane = count_++;
  const ImagePatch& patch = surface.patch_of(start.span);
  const SpanDomain d = surface.domain(start.span);
  const bool inside = start.u >= d.u_min && start.u <= d.u_max && start.v >= d.v_min && start.v <= d.v_max;
  open_[lane] = inside && patch.degree_u == 3 && patch.degree_v == 3 && available_ && surface.holds_taylor();
  if (!open_[lane]) return;
  used_ = lane;
  place_[lane] = start;
  walk_.taylor[lane] = surface.taylor(start.span, nullptr);
  walk_.per_u[lane] = 1.0 / (d.u_max - d.u_min);
  walk_.per_v[lane] = 1.0 / (d.v_max - d.v_min);
  walk_.x[lane] = (start.u - d.u_min) * walk_.per_u[lane] - 0.5;
  walk_.y[lane] = (start.v - d.v_min) * walk_.per_v[lane] - 0.5;
  for (int k = 0; k < 3; ++k) walk_.r[k][lane] = r[k];
}

void LaneProjections::find(const Surface& surface) {
  if (used_ == kLanes) return;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    if (lane < count_ && open_[lane]) continue;
    // A lane that is not in use does what another does.
    walk_.taylor[lane] = walk_.taylor[used_];
    for (LaneNumbers* numbers : {&walk_.per_u, &walk_.per_v, &walk_.x, &walk_.y, walk_.r, walk_.r + 1, walk_.r + 2})
      (*numbers)[lane] = (*numbers)[used_];
  }
  walk_.last_step = kLastStep * surface.half_diagonal();
  walk_.slack = kDistanceRounding * surface.half_diagonal();
  walk_lanes(walk_);
  for (std::uint32_t lane = 0; lane < count_; ++lane) {
    open_[lane] = open_[lane] && walk_.converged[lane];
    if (!open_[lane]) continue;
    SurfacePlace& place = place_[lane];
    const SpanDomain d = surface.domain(place.span);
    place.u = d.u_min + (walk_.x[lane] + 0.5) * (d.u_max - d.u_min);
    place.v = d.v_min + (walk_.y[lane] + 0.5) * (d.v_max - d.v_min);
    place = clamped(place, ParameterLimits());
    if (surface.has_trims()) open_[lane] = inside_face(surface.image(), place);
  }
}

Projection LaneProjections::projection(std::uint32_t lane) const {
  Projection p;
  p.place = place_[lane];
  p.at = {lane_of(walk_.s, lane),    lane_of(walk_.s_u, lane),  lane_of(walk_.s_v, lane),
          lane_of(walk_.s_uu, lane), lane_of(walk_.s_uv, lane), lane_of(walk_.s_vv, lane)};
  p.offset = lane_of(walk_.offset, lane);
  p.converged = true;
  return p;
}

Vec3 LaneProjections::point(std::uint32_t lane) const { return lane_of(walk_.r, lane); }
Vec3 LaneProjections::surface_point(std::uint32_t lane) const { return lane_of(walk_.s, lane); }
Vec3 LaneProjections::offset(std::uint32_t lane) const { return lane_of(walk_.offset, lane); }
Vec3 LaneProjections::cross(std::uint32_t lane) const {
  return lane_of(walk_.s_u, lane).cross(lane_of(walk_.s_v, lane));
}

}  // namespace bladefit
