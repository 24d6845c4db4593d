#include "core/fit/facing_row.hpp"

#include <Eigen/Geometry>

namespace bladefit {
namespace {

/// A symmetric 2 x 2 matrix times a vector, and its inverse times one.
struct Form {
  double uu, uv, vv;
  [[nodiscard]] double determinant() const { return uu * vv - uv * uv; }
  [[nodiscard]] Eigen::Vector2d times(const Eigen::Vector2d& x) const {
    return {uu * x[0] + uv * x[1], uv * x[0] + vv * x[1]};
  }
  [[nodiscard]] Eigen::Vector2d solve(const Eigen::Vector2d& x) const {
    return Eigen::Vector2d(vv * x[0] - uv * x[1], uu * x[1] - uv * x[0]) / determinant();
  }
};

/// (dn/dr)' a = -T M^-1 B G^-1 T' a: G, B first and second fundamental form, M = G - phi B, T = [Su Sv].
Vec3 turn_of_normal(const Projection& projection, const Vec3& normal, const Vec3& a) {
  const SurfacePoint& s = projection.at;
  const double phi = normal.dot(projection.offset);
  const Form g{s.s_u.squaredNorm(), s.s_u.dot(s.s_v), s.s_v.squaredNorm()};
  const Form b{normal.dot(s.s_uu), normal.dot(s.s_uv), normal.dot(s.s_vv)};
  const Form m{g.uu - phi * b.uu, g.uv - phi * b.uv, g.vv - phi * b.vv};
  const double size = g.uu * g.vv;
  if (!(g.determinant() > 1e-12 * size) || !(m.determinant() > 1e-12 * size)) return Vec3::Zero();
  const Eigen::Vector2d y = m.solve(b.times(g.solve({s.s_u.dot(a), s.s_v.dot(a)})));
  return -(y[0] * s.s_u + y[1] * s.s_v);
}

}  // namespace

FacingRow facing_row(const Projection& projection, const Vec3& normal, const Vec3& r, const Vec3& approach,
                     const MotionFrame& frame) {
  FacingRow row;
  row.facing = normal.dot(approach);
  const Vec3 moved = turn_of_normal(projection, normal, approach);
  row.gradient.head<3>() = ((r - frame.pivot).cross(moved) + approach.cross(normal)) / frame.length;
  row.gradient.tail<3>() = moved;
  return row;
}

}  // namespace bladefit
