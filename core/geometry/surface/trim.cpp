#include "core/geometry/surface/trim.hpp"

namespace bladefit {

Vec3 out_of_face(const SurfacePoint& at, double du, double dv) {
  const Vec3 along = tangent_along(at, du, dv), right = tangent_along(at, dv, -du);
  const double square = along.squaredNorm();
  const Vec3 out = square > 0.0 ? Vec3(right - (right.dot(along) / square) * along) : right;
  const double size = out.norm();
  return size > 1e-9 * right.norm() ? Vec3(out / size) : Vec3(Vec3::Zero());
}

bool inside_face(const DesignImage& image, const SurfacePlace& place) {
  const ImagePatch& patch = image.patches()[image.spans()[place.span].patch];
  if (patch.slab_count == 0) return true;
  const ImageSlab& slab = image.slabs()[patch.first_slab + slab_of(place.v, patch.slab_count)];
  bool inside = false;
  for (const std::uint32_t k : image.slab_trims().subspan(slab.first, slab.count)) {
    const ImageTrim& a = image.trims()[k];
    const ImageTrim& b = image.trims()[a.next];
    if ((a.v > place.v) == (b.v > place.v)) continue;
    // Its crossing with the line v = const. lies at a smaller u.
    const double turn = (b.u - a.u) * (place.v - a.v) - (b.v - a.v) * (place.u - a.u);
    if ((turn < 0.0) == (b.v > a.v)) inside = !inside;
  }
  return inside;
}

}  // namespace bladefit
