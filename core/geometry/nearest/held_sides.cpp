#include "core/geometry/nearest/held_sides.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

/// One direction in which a projection is held.
struct HeldSide {
  bool counts = false;
  Joint joint = Joint::none;
};

/// The part of a side that the parameter along it lies in.
std::uint32_t part_at(double t, double low, double high) {
  const double share = std::clamp((t - low) / (high - low), 0.0, 1.0);
  return std::min(static_cast<std::uint32_t>(share * kJointParts), kJointParts - 1);
}

/// `low`: the side where the parameter is least. `across`: derivative towards the side of the greatest.
HeldSide held_side(const Surface& surface, const Projection& projection, std::size_t low, const Vec3& across) {
  const SurfacePlace& place = projection.place;
  const SpanDomain d = surface.domain(place.span);
  const std::size_t side = low + (projection.offset.dot(across) > 0.0 ? 1 : 0);
  const std::uint32_t part = low == kLowU ? part_at(place.v, d.v_min, d.v_max) : part_at(place.u, d.u_min, d.u_max);
  const Joint joint = joint_of_part(surface.span(place.span).joints[side], part);
  if (joint != Joint::smooth) return {true, joint};
  const double most = joint_gap(surface.half_diagonal()) + kMostBend * projection.offset.norm();
  return {std::abs(projection.offset.dot(across)) > most * across.norm(), joint};
}

/// Share of the offset that leads out of the patch across the side, square to `along` it. Where the parametrisation is
/// degenerate there is no such direction, and all of it does. Where another outer edge faces this one, what lies on the
/// end between the two is not beyond, although that end leans out as far as both sides converge.
double share_beyond(const Surface& surface, const Projection& projection, Joint joint, const Vec3& across,
                    const Vec3& along) {
  const double length = projection.offset.norm(), square = along.squaredNorm();
  Vec3 out = across;
  if (square > 0.0) out -= (across.dot(along) / square) * along;
  const double size = out.norm();
  if (!(size > 1e-9 * across.norm()) || !(length > 0.0)) return 1.0;
  const double sense = projection.offset.dot(across) > 0.0 ? 1.0 : -1.0;
  const double beyond = sense * projection.offset.dot(out) / (size * length);
  const double lean = lean_of(joint);
  if (lean == 0.0) return beyond;
  const double depth = -surface.normal(projection.place, projection.at).dot(projection.offset) / length;
  return beyond - lean * std::max(0.0, depth);
}

/// Which side of the material a point is on whose foot is on these joints.
double side_of(const Surface& surface, const Projection& projection, const HeldSide& u, const HeldSide& v) {
  const bool only_ridges = (!u.counts || u.joint == Joint::ridge) && (!v.counts || v.joint == Joint::ridge);
  const bool only_valleys = (!u.counts || u.joint == Joint::valley) && (!v.counts || v.joint == Joint::valley);
  if (only_ridges || only_valleys) return only_ridges ? 1.0 : -1.0;
  return surface.outward(projection.place, projection.at).dot(projection.offset) < 0.0 ? -1.0 : 1.0;
}

}  // namespace

HeldSides held_sides(const Surface& surface, const Projection& projection) {
  HeldSides out;
  if (!projection.fixed_u && !projection.fixed_v) return out;
  const SurfacePoint& at = projection.at;
  HeldSide u, v;
  if (projection.fixed_u) u = held_side(surface, projection, kLowU, at.s_u);
  if (projection.fixed_v) v = held_side(surface, projection, kLowV, at.s_v);
  out.count = (u.counts ? 1 : 0) + (v.counts ? 1 : 0);
  if (out.count == 0) return out;
  const bool ends_u = u.counts && is_outer(u.joint), ends_v = v.counts && is_outer(v.joint);
  const bool joins = (u.counts && !ends_u) || (v.counts && !ends_v);
  if (!ends_u && !ends_v) {
    out.border = FootBorder::joint;
    out.side = side_of(surface, projection, u, v);
    return out;
  }
  out.border = joins ? FootBorder::joint_end : FootBorder::outer;
  if (ends_u) out.outward = std::max(out.outward, share_beyond(surface, projection, u.joint, at.s_u, at.s_v));
  if (ends_v) out.outward = std::max(out.outward, share_beyond(surface, projection, v.joint, at.s_v, at.s_u));
  return out;
}

bool falls_over_seam(const Surface& surface, const Projection& projection) {
  const SurfacePoint& at = projection.at;
  const auto over = [&](bool fixed, std::size_t low, const Vec3& across) {
    return fixed && held_side(surface, projection, low, across).joint == Joint::smooth;
  };
  return over(projection.fixed_u, kLowU, at.s_u) || over(projection.fixed_v, kLowV, at.s_v);
}

}  // namespace bladefit
