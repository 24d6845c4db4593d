#include "core/fit/existence_row.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace bladefit {
namespace {

/// Of the patch parameters, for differences.
constexpr double kStep = 1e-5;

/// First fundamental form and the one of the distance, M = G - phi B.
struct Forms {
  double g_uu, g_uv, g_vv, m_uu, m_uv, m_vv;
  [[nodiscard]] double g() const { return g_uu * g_vv - g_uv * g_uv; }
  [[nodiscard]] double ratio() const { return (m_uu * m_vv - m_uv * m_uv) / g(); }
};

Forms forms_of(const SurfacePoint& s, double phi, double side) {
  const Vec3 n = side * s.s_u.cross(s.s_v).normalized();
  Forms f{s.s_u.squaredNorm(), s.s_u.dot(s.s_v), s.s_v.squaredNorm(), 0.0, 0.0, 0.0};
  f.m_uu = f.g_uu - phi * n.dot(s.s_uu);
  f.m_uv = f.g_uv - phi * n.dot(s.s_uv);
  f.m_vv = f.g_vv - phi * n.dot(s.s_vv);
  return f;
}

/// The ratio beside the foot, `u` and `v` parameters away, and how far away that is within the patch.
double ratio_beside(const Surface& surface, SurfacePlace place, double u, double v, double phi, double& way) {
  const double before = u != 0.0 ? place.u : place.v;
  place.u = std::clamp(place.u + u, 0.0, 1.0);
  place.v = std::clamp(place.v + v, 0.0, 1.0);
  way += std::abs((u != 0.0 ? place.u : place.v) - before);
  surface.settle(place);
  return forms_of(surface.evaluate(place), phi, surface.side_of(place.span)).ratio();
}

double slope_along(const Surface& surface, const SurfacePlace& place, double u, double v, double phi) {
  double way = 0.0;
  const double above = ratio_beside(surface, place, u, v, phi, way);
  const double below = ratio_beside(surface, place, -u, -v, phi, way);
  return (above - below) / way;
}

}  // namespace

ExistenceRow existence_row(const Surface& surface, const Projection& projection, const Vec3& normal, const Vec3& r,
                           const MotionFrame& frame) {
  ExistenceRow row;
  const SurfacePoint& s = projection.at;
  const double phi = normal.dot(projection.offset);
  const Forms f = forms_of(s, phi, surface.side_of(projection.place.span));
  if (!(f.g() > 1e-12 * f.g_uu * f.g_vv)) return row;
  const double ratio = f.ratio();
  const double d_u = slope_along(surface, projection.place, kStep, 0.0, phi);
  const double d_v = slope_along(surface, projection.place, 0.0, kStep, phi);
  // The foot moves by M^-1 T' dr, T = [Su Sv]; the ratio times M^-1 is the adjugate of M over det G.
  const double a = (d_u * f.m_vv - d_v * f.m_uv) / f.g(), b = (d_v * f.m_uu - d_u * f.m_uv) / f.g();
  const double trace =
      (f.g_vv * (f.m_uu - f.g_uu) + f.g_uu * (f.m_vv - f.g_vv) - 2.0 * f.g_uv * (f.m_uv - f.g_uv)) / f.g();
  const double bend = ((f.m_uu - f.g_uu) * (f.m_vv - f.g_vv) - (f.m_uv - f.g_uv) * (f.m_uv - f.g_uv)) / f.g();
  const double d_phi = phi != 0.0 ? (trace + 2.0 * bend) / phi : 0.0;  // ratio = 1 + trace + bend, of phi and phi^2
  const Vec3 slope = 2.0 * (a * s.s_u + b * s.s_v + ratio * d_phi * normal);
  row.existence = ratio * ratio;
  row.gradient.head<3>() = (r - frame.pivot).cross(slope) / frame.length;
  row.gradient.tail<3>() = slope;
  return row;
}

}  // namespace bladefit
