#include "core/geometry/nearest/held_sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/surface/trim.hpp"

namespace bladefit {
namespace {

/// One direction in which a projection is held.
struct HeldSide {
  bool counts = false;
  Joint joint = Joint::none;
  Vec3 across = Vec3::Zero(), along = Vec3::Zero();  ///< derivatives towards or away from the end, and along it
};

/// The part of a side that the parameter along it lies in.
std::uint32_t part_at(double t, double low, double high) {
  const double share = std::clamp((t - low) / (high - low), 0.0, 1.0);
  return std::min(static_cast<std::uint32_t>(share * kJointParts), kJointParts - 1);
}

/// `low`: the side where the parameter is least. `across`: derivative towards the side of the greatest.
HeldSide held_side(const Surface& surface, const Projection& projection, std::size_t low, const Vec3& across,
                   const Vec3& along) {
  const SurfacePlace& place = projection.place;
  const SpanDomain d = surface.domain(place.span);
  const std::size_t side = low + (projection.offset.dot(across) > 0.0 ? 1 : 0);
  const std::uint32_t part = low == kLowU ? part_at(place.v, d.v_min, d.v_max) : part_at(place.u, d.u_min, d.u_max);
  const Joint joint = joint_of_part(surface.span(place.span).joints[side], part);
  if (joint != Joint::smooth) return {true, joint, across, along};
  const double most = joint_gap(surface.half_diagonal()) + kMostBend * projection.offset.norm();
  return {std::abs(projection.offset.dot(across)) > most * across.norm(), joint, across, along};
}

/// The same at a piece of a trim loop that runs along (du, dv).
HeldSide held_trim(const Surface& surface, const Projection& projection, const ImageTrim& trim, double du, double dv) {
  const auto joint = static_cast<Joint>(trim.joint);
  const Vec3 out = out_of_face(projection.at, du, dv);
  const double most = joint_gap(surface.half_diagonal()) + kMostBend * projection.offset.norm();
  return {joint != Joint::smooth || std::abs(projection.offset.dot(out)) > most, joint, out,
          tangent_along(projection.at, du, dv)};
}

/// What a projection is held at: a side in u and one in v, or up to two pieces of a trim loop.
std::array<HeldSide, 2> sides_held(const Surface& surface, const Projection& projection) {
  std::array<HeldSide, 2> sides;
  const SurfacePoint& at = projection.at;
  if (projection.on_trim()) {
    const auto trims = surface.image().trims();
    const ImageTrim& trim = trims[projection.trim.trim];
    sides[0] = held_trim(surface, projection, trim, projection.trim.du, projection.trim.dv);
    if (!projection.trim.at_corner) return sides;
    const TrimLine before = line_of(surface.image(), trim.previous);
    sides[1] = held_trim(surface, projection, trims[trim.previous], before.du, before.dv);
    return sides;
  }
  if (projection.fixed_u) sides[0] = held_side(surface, projection, kLowU, at.s_u, at.s_v);
  if (projection.fixed_v) sides[1] = held_side(surface, projection, kLowV, at.s_v, at.s_u);
  return sides;
}

/// Share of the offset that leads out of the patch across the side, square to `along` it. Where the parametrisation is
/// degenerate there is no such direction, and all of it does. Where another outer edge faces this one, what lies on the
/// end between the two is not beyond, although that end leans out as far as both sides converge.
double share_beyond(const Surface& surface, const Projection& projection, const HeldSide& side) {
  const Vec3 &across = side.across, &along = side.along;
  const double length = projection.offset.norm(), square = along.squaredNorm();
  Vec3 out = across;
  if (square > 0.0) out -= (across.dot(along) / square) * along;
  const double size = out.norm();
  if (!(size > 1e-9 * across.norm()) || !(length > 0.0)) return 1.0;
  const double sense = projection.offset.dot(across) > 0.0 ? 1.0 : -1.0;
  const double beyond = sense * projection.offset.dot(out) / (size * length);
  const double lean = lean_of(side.joint);
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
  if (!projection.fixed_u && !projection.fixed_v && !projection.on_trim()) return out;
  const auto [u, v] = sides_held(surface, projection);
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
  if (ends_u) out.outward = std::max(out.outward, share_beyond(surface, projection, u));
  if (ends_v) out.outward = std::max(out.outward, share_beyond(surface, projection, v));
  return out;
}

bool falls_over_seam(const Surface& surface, const Projection& projection) {
  const SurfacePoint& at = projection.at;
  return (projection.fixed_u && held_side(surface, projection, kLowU, at.s_u, at.s_v).joint == Joint::smooth) ||
         (projection.fixed_v && held_side(surface, projection, kLowV, at.s_v, at.s_u).joint == Joint::smooth);
}

}  // namespace bladefit
