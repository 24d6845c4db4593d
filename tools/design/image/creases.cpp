#include "tools/design/image/creases.hpp"

#include <Eigen/Geometry>

#include "core/geometry/surface/surface.hpp"

namespace bladefit {
namespace {

/// Normals that differ by more than this [rad] make a crease.
constexpr double kCreaseAngle = 1e-6;
/// Along a side normals are compared at this many places.
constexpr int kPlacesAcross = 9;

/// Su x Sv at a place of a span; zero where the parametrisation is degenerate.
Vec3 direction(const BezierPatch& patch, std::size_t iu, std::size_t iv, double s, double t) {
  HomogeneousDerivatives h;
  evaluate_taylor(&patch.taylor[(iu * patch.spans_v() + iv) * patch.span_size()],
                  static_cast<std::uint32_t>(patch.degree_u), static_cast<std::uint32_t>(patch.degree_v), s - 0.5,
                  t - 0.5, h);
  const SurfacePoint point = projected(h);
  const Vec3 cross = point.s_u.cross(point.s_v);
  return cross.norm() > 1e-6 * point.s_u.norm() * point.s_v.norm() ? Vec3(cross.normalized()) : Vec3(Vec3::Zero());
}

/// The surface has a crease between a span and the next one, in u or in v.
bool creased(const BezierPatch& patch, std::size_t iu, std::size_t iv, bool along_u) {
  for (int k = 0; k < kPlacesAcross; ++k) {
    const double x = static_cast<double>(k) / (kPlacesAcross - 1);
    const Vec3 here = along_u ? direction(patch, iu, iv, 1.0, x) : direction(patch, iu, iv, x, 1.0);
    const Vec3 next = along_u ? direction(patch, iu + 1, iv, 0.0, x) : direction(patch, iu, iv + 1, x, 0.0);
    if (here.cross(next).norm() > kCreaseAngle || here.dot(next) < 0.0) return true;
  }
  return false;
}

}  // namespace

std::uint32_t span_ends(const BezierPatch& patch, std::size_t iu, std::size_t iv) {
  std::uint32_t ends = 0;
  if (iu == 0 || creased(patch, iu - 1, iv, true)) ends |= kEndsAtLowU;
  if (iu + 1 == patch.spans_u() || creased(patch, iu, iv, true)) ends |= kEndsAtHighU;
  if (iv == 0 || creased(patch, iu, iv - 1, false)) ends |= kEndsAtLowV;
  if (iv + 1 == patch.spans_v() || creased(patch, iu, iv, false)) ends |= kEndsAtHighV;
  return ends;
}

}  // namespace bladefit
