#include "tools/design/image/seams.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "core/geometry/nearest/global_projection.hpp"

namespace bladefit {
namespace {

/// The surface is looked for this far beyond an edge [half diagonals].
constexpr double kBeyond = 2e-4;
/// There it is where the place is no farther from it than this share of the way, and its normal turns by no more [rad].
constexpr double kFarthest = 0.4, kMostBend = 0.05;
constexpr std::array<double, 5> kPlaces = {0.1, 0.3, 0.5, 0.7, 0.9};

/// One side of a span: u or v at its low or high limit.
struct Side {
  std::uint32_t end, seam;
  bool along_v;  ///< the side runs along v
  bool high;
};
constexpr std::array<Side, 4> kSides = {{{kEndsAtLowU, kSeamAtLowU, true, false},
                                         {kEndsAtHighU, kSeamAtHighU, true, true},
                                         {kEndsAtLowV, kSeamAtLowV, false, false},
                                         {kEndsAtHighV, kSeamAtHighV, false, true}}};

/// The surface goes on beyond one place of a side.
bool goes_on(const Surface& surface, const SurfacePlace& place, const Side& side) {
  const SurfacePoint at = surface.evaluate(place);
  const Vec3 normal = surface.normal(place, at);
  // Across the side, in the tangent plane, away from the patch.
  const Vec3 along = side.along_v ? at.s_v : at.s_u, rising = side.along_v ? at.s_u : at.s_v;
  if (!(along.norm() > 0.0)) return false;
  Vec3 across = along.cross(normal).normalized();
  if ((across.dot(rising) > 0.0) != side.high) across = -across;
  const double step = kBeyond * surface.half_diagonal();
  const ProjectionQuery query{at.s + step * across, Vec3::Zero(), 0.0};
  const Projection found = project_global(surface, query, nullptr).nearest;
  if (!found.converged || found.fixed_u || found.fixed_v) return false;
  const bool near = std::sqrt(found.distance_squared()) < kFarthest * step;
  return near && surface.normal(found.place, found.at).dot(normal) > std::cos(kMostBend);
}

bool is_seam(const Surface& surface, std::uint32_t span, const Side& side) {
  const SpanDomain d = surface.domain(span);
  for (const double t : kPlaces) {
    const double u = d.u_min + t * (d.u_max - d.u_min), v = d.v_min + t * (d.v_max - d.v_min);
    const SurfacePlace place = side.along_v ? SurfacePlace{span, side.high ? d.u_max : d.u_min, v}
                                            : SurfacePlace{span, u, side.high ? d.v_max : d.v_min};
    if (!goes_on(surface, place, side)) return false;
  }
  return true;
}

/// The side is an edge of the patch, not a crease inside it.
bool on_edge(const ImageSpan& span, const ImagePatch& patch, const Side& side) {
  const std::uint32_t index = side.along_v ? span.iu : span.iv, count = side.along_v ? patch.spans_u : patch.spans_v;
  return index == (side.high ? count - 1 : 0);
}

}  // namespace

void mark_seams(std::vector<std::byte>& image) {
  DesignImage design;
  if (const Status status = DesignImage::open(image, design); status != Status::ok)
    throw std::logic_error(std::string("a new image is not valid: ") + status_text(status));
  const Surface surface(design);
  std::vector<ImageSpan> spans(design.spans().begin(), design.spans().end());
  for (std::uint32_t k = 0; k < spans.size(); ++k) {
    for (const Side& side : kSides) {
      if (on_edge(spans[k], design.patches()[spans[k].patch], side) && is_seam(surface, k, side))
        spans[k].ends |= side.seam;
    }
  }
  std::memcpy(image.data() + design.header().spans_offset, spans.data(), spans.size() * sizeof(ImageSpan));
}

}  // namespace bladefit
