#include "tools/design/image/joints.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

#include "core/geometry/surface/trim.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/image/meeting_surface.hpp"

namespace bladefit {
namespace {

/// Where a part of a side is looked at.
constexpr std::array<double, 3> kPlaces = {0.1, 0.5, 0.9};
/// The cosines of the angle between the normals, and between the ways on in the two surfaces, differ by no more than
/// this where both normals point out of the same material.
constexpr double kSameMaterial = 0.5;
/// Two surfaces that meet back to back, in a knife edge, have no angle to tell a ridge from a valley by.
constexpr double kKnife = 0.05;

/// One side of a span.
struct Side {
  std::size_t index;
  bool along_v;  ///< it runs along v
  bool high;
};
constexpr std::array<Side, 4> kSides = {
    {{kLowU, true, false}, {kHighU, true, true}, {kLowV, false, false}, {kHighV, false, true}}};

/// A place of a side: unit vectors along the outward normal, and square to the side and the normal, out of the span.
struct SidePlace {
  SurfacePlace place;
  Vec3 point, normal, onward;
};

/// Nothing where the side is a point.
std::optional<SidePlace> side_place(const Surface& surface, const SurfacePlace& place, const Side& side) {
  const SurfacePoint at = surface.evaluate(place);
  const Vec3 along = side.along_v ? at.s_v : at.s_u, rising = side.along_v ? at.s_u : at.s_v;
  if (!(along.norm() > 1e-6 * rising.norm())) return std::nullopt;
  const Vec3 normal = surface.normal(place, at);
  Vec3 onward = along.cross(normal).normalized();
  if ((onward.dot(rising) > 0.0) != side.high) onward = -onward;
  return SidePlace{place, at.s, normal, onward};
}

/// The bend from the normal at a side to that of the surface that goes on there.
Joint bend(const SidePlace& from, const Vec3& normal) {
  const double turned = from.normal.dot(normal);
  if (turned >= std::cos(kMostBend)) return Joint::smooth;
  if (turned > 0.0) return Joint::bent;
  return from.onward.dot(normal) > -kKnife ? Joint::ridge : Joint::valley;
}

/// What lies beyond one place of an edge of a patch.
Joint joint_beyond(const MeetingSurface& meeting, const SidePlace& from) {
  const std::optional<MeetingPlace> met = meeting.find(from.place, from.point);
  if (!met) return Joint::none;
  const Joint found = bend(from, met->normal);
  if (!met->inward) return found == Joint::smooth && !meeting.reaches(from.point, from.onward) ? Joint::none : found;
  const double way = met->inward->dot(from.onward);
  return std::abs(way - met->normal.dot(from.normal)) <= kSameMaterial ? found : Joint::none;
}

/// An outer edge, and how the end leans that leads from it to another one across the material.
Joint outer_edge(const MeetingSurface& meeting, const SidePlace& from) {
  const std::optional<Vec3> way = meeting.facing_edge(from.place, from.point, from.normal, from.onward);
  if (!way) return Joint::none;
  const double lean = std::max(0.0, way->dot(from.onward)) / -way->dot(from.normal);
  const auto bound = std::lower_bound(kLeans.begin(), kLeans.end(), lean);
  if (bound == kLeans.end()) return Joint::none;
  return static_cast<Joint>(static_cast<int>(Joint::open) + (bound - kLeans.begin()));
}

/// One joint for places that were found to be these.
Joint both(Joint a, Joint b) {
  if (is_outer(a) && is_outer(b)) return std::max(a, b);
  if (is_outer(a) || is_outer(b)) return is_outer(a) ? a : b;
  if (a == b) return a;
  if (a == Joint::smooth || b == Joint::smooth) return a == Joint::smooth ? both(Joint::bent, b) : both(a, Joint::bent);
  return a == Joint::bent ? b : b == Joint::bent ? a : Joint::bent;
}

class JointMarker {
 public:
  explicit JointMarker(const Surface& surface) : surface_(surface), meeting_(surface) {}

  /// All parts of a side that the surface ends at, or has a crease at.
  [[nodiscard]] std::uint64_t parts(std::uint32_t span, const Side& side) const {
    const std::optional<std::uint32_t> next = span_beyond(span, side);
    std::uint64_t out = 0;
    for (std::uint32_t part = 0; part < kJointParts; ++part) {
      std::optional<Joint> joint;
      for (const double place : kPlaces) {
        const Joint one = joint_at(span, side, (part + place) / kJointParts, next);
        joint = joint ? both(*joint, one) : one;
      }
      out = with_joint(out, part, *joint);
    }
    return out;
  }

  /// What lies beyond a piece of a trim loop.
  [[nodiscard]] Joint beyond(std::uint32_t trim) const {
    std::optional<Joint> joint;
    for (const double place : kPlaces) {
      const Joint one = joint_on(line_of(surface_.image(), trim), place);
      joint = joint ? both(*joint, one) : one;
    }
    return *joint;
  }

 private:
  [[nodiscard]] Joint joint_on(const TrimLine& line, double share) const {
    const SpanDomain d = surface_.domain(line.span);
    SurfacePlace place = line.at(share);
    place.u = std::clamp(place.u, d.u_min, d.u_max);
    place.v = std::clamp(place.v, d.v_min, d.v_max);
    const SurfacePoint at = surface_.evaluate(place);
    const Vec3 onward = out_of_face(at, line.du, line.dv);
    if (onward.isZero()) return Joint::none;
    return joint_or_edge({place, at.s, surface_.normal(place, at), onward});
  }

  [[nodiscard]] Joint joint_or_edge(const SidePlace& from) const {
    const Joint joint = joint_beyond(meeting_, from);
    return joint == Joint::none ? outer_edge(meeting_, from) : joint;
  }

  /// The span of the same patch on the other side of a crease; nothing at the edge of the patch.
  [[nodiscard]] std::optional<std::uint32_t> span_beyond(std::uint32_t span, const Side& side) const {
    const ImageSpan& s = surface_.span(span);
    const ImagePatch& p = surface_.patch_of(span);
    const std::uint32_t index = side.along_v ? s.iu : s.iv, count = side.along_v ? p.spans_u : p.spans_v;
    if (index == (side.high ? count - 1 : 0)) return std::nullopt;
    const std::uint32_t step = side.along_v ? p.spans_v : 1;
    return side.high ? span + step : span - step;
  }

  [[nodiscard]] Joint joint_at(std::uint32_t span, const Side& side, double share,
                               const std::optional<std::uint32_t>& next) const {
    const SpanDomain d = surface_.domain(span);
    const double u = d.u_min + share * (d.u_max - d.u_min), v = d.v_min + share * (d.v_max - d.v_min);
    SurfacePlace place = side.along_v ? SurfacePlace{span, side.high ? d.u_max : d.u_min, v}
                                      : SurfacePlace{span, u, side.high ? d.v_max : d.v_min};
    const std::optional<SidePlace> from = side_place(surface_, place, side);
    if (!from) return Joint::none;
    if (!next) return joint_or_edge(*from);
    place.span = *next;
    return bend(*from, surface_.normal(place, surface_.evaluate(place)));
  }

  const Surface& surface_;
  MeetingSurface meeting_;
};

}  // namespace

void mark_joints(std::vector<std::byte>& image) {
  const DesignImage design = open_new_image(image);
  const Surface surface(design);
  const JointMarker marker(surface);
  std::vector<ImageSpan> spans(design.spans().begin(), design.spans().end());
  for (std::uint32_t k = 0; k < spans.size(); ++k) {
    for (const Side& side : kSides) {
      if ((spans[k].ends & (1U << side.index)) != 0) spans[k].joints[side.index] = marker.parts(k, side);
    }
  }
  std::vector<ImageTrim> trims(design.trims().begin(), design.trims().end());
  for (std::uint32_t k = 0; k < trims.size(); ++k) trims[k].joint = static_cast<std::uint16_t>(marker.beyond(k));
  const std::uint64_t trims_at = design.header().trims_offset;
  std::memcpy(image.data() + design.header().spans_offset, spans.data(), spans.size() * sizeof(ImageSpan));
  if (!trims.empty()) std::memcpy(image.data() + trims_at, trims.data(), trims.size() * sizeof(ImageTrim));
}

}  // namespace bladefit
