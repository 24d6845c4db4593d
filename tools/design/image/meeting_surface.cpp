#include "tools/design/image/meeting_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/geometry/nearest/bounding_tree.hpp"
#include "core/geometry/nearest/global_projection.hpp"
#include "core/geometry/nearest/leaf_bounds.hpp"
#include "core/geometry/surface/trim.hpp"

namespace bladefit {
namespace {

/// Two places of a patch are one neighbourhood where no place between them is farther away than this many gaps.
constexpr double kNeighbourhood = 4.0;
/// Surface is looked for so many gaps away, and is there where it is nearer to that place than this share of the way.
constexpr double kWay = 3.0, kFarthest = 0.75;
/// A blunt edge is no thicker than this [half diagonals].
constexpr double kThickest = 0.05;

/// A place on a trim loop counts as so much nearer than one in the middle of a face [gaps]: loops of faces that meet
/// are a tolerance apart, or overlap by it.
constexpr double kLoopFirst = 0.25;
/// An edge that faces another one across the material lies this deep at least [way].
constexpr double kLeastDepth = 0.5;

/// A leaf is looked at in so many parts in each direction: it may be so bent that from its middle not all of its places
/// are reached.
constexpr int kLeafParts = 4;

/// Part k of kLeafParts of a range.
std::pair<double, double> part_of(double low, double high, int k) {
  const auto at = [&](int i) { return i == kLeafParts ? high : low + (high - low) * i / kLeafParts; };
  return {at(k), at(k + 1)};
}

/// Pieces are nearly straight: some steps along the tangent are enough.
TrimPlace nearest_on(const Surface& surface, std::uint32_t trim, const Vec3& point) {
  const TrimLine line = line_of(surface.image(), trim);
  const SpanDomain d = surface.domain(line.span);
  TrimPlace found;
  double t = 0.5;
  for (int k = 0; k < 6; ++k) {
    const SurfacePlace place = line.at(t);
    found.place = {line.span, std::clamp(place.u, d.u_min, d.u_max), std::clamp(place.v, d.v_min, d.v_max)};
    found.at = surface.evaluate(found.place);
    found.offset = point - found.at.s;
    const Vec3 way = tangent_along(found.at, line.du, line.dv);
    const double square = way.squaredNorm();
    if (!(square > 0.0)) break;
    t = std::clamp(t + found.offset.dot(way) / square, 0.0, 1.0);
  }
  found.inward = -out_of_face(found.at, line.du, line.dv);
  return found;
}

/// Parameters of a leaf within its patch.
ParameterLimits limits_of(const Surface& surface, const ImageLeaf& leaf) {
  const SpanDomain d = surface.domain(leaf.span);
  const auto at = [](double low, double high, double x) {
    return x <= 0.0 ? low : x >= 1.0 ? high : low + x * (high - low);
  };
  return {at(d.u_min, d.u_max, leaf.s_min), at(d.u_min, d.u_max, leaf.s_max), at(d.v_min, d.v_max, leaf.t_min),
          at(d.v_min, d.v_max, leaf.t_max)};
}

/// A place so near to the edge of its patch is on it [gaps]: rounding.
constexpr double kOnEdge = 1e-6;

/// A foot that is on the edge of its patch but for rounding, there.
Projection on_edge(const Surface& surface, const Projection& p, double near) {
  const auto snapped = [near](double t, double speed) {
    if (t * speed <= near) return 0.0;
    return (1.0 - t) * speed <= near ? 1.0 : t;
  };
  Projection out = p;
  out.place.u = snapped(p.place.u, p.at.s_u.norm());
  out.place.v = snapped(p.place.v, p.at.s_v.norm());
  if (out.place.u != p.place.u || out.place.v != p.place.v) out.at = surface.evaluate(out.place);
  return out;
}

/// Unit vector into the patch at a place of its edge; nothing inside of it.
std::optional<Vec3> into_patch(const Projection& p) {
  const auto inward = [](double t, const Vec3& tangent, const Vec3& along) -> Vec3 {
    if (t > 0.0 && t < 1.0) return Vec3::Zero();
    const double square = along.squaredNorm();
    Vec3 across = tangent;
    if (square > 0.0) across -= (tangent.dot(along) / square) * along;
    const double size = across.norm();
    if (!(size > 0.0)) return Vec3::Zero();
    return (t > 0.0 ? -1.0 : 1.0) / size * across;
  };
  const Vec3 sum = inward(p.place.u, p.at.s_u, p.at.s_v) + inward(p.place.v, p.at.s_v, p.at.s_u);
  const double size = sum.norm();
  return size > 0.0 ? std::optional<Vec3>(sum / size) : std::nullopt;
}

}  // namespace

MeetingSurface::MeetingSurface(const Surface& surface) : surface_(surface), gap_(joint_gap(surface.half_diagonal())) {}

template <class UseLeaf, class UseRun>
void MeetingSurface::each_near(const Vec3& point, double reach, UseLeaf use_leaf, UseRun use_run) const {
  const auto leaves = static_cast<std::uint32_t>(surface_.image().leaves().size());
  const BoxDistances boxes(point - surface_.middle());
  const float threshold = boxes.threshold(reach);
  std::vector<std::uint32_t> pending = {0};
  while (!pending.empty()) {
    const ImageNode& node = surface_.image().nodes()[pending.back()];
    pending.pop_back();
    const BoxDistances::Four squares = boxes.squares(node);
    for (int k = 0; k < 4; ++k) {
      if (!(squares[k] < threshold)) continue;
      const std::uint32_t child = node.child[k];
      if ((child & kLeafChild) == 0) {
        pending.push_back(child);
      } else if (const std::uint32_t index = child & ~kLeafChild; index < leaves) {
        use_leaf(index);
      } else {
        use_run(surface_.image().runs()[index - leaves]);
      }
    }
  }
}

std::optional<MeetingPlace> MeetingSurface::find(const SurfacePlace& own, const Vec3& point) const {
  std::optional<MeetingPlace> best;
  each_near(
      point, gap_, [&](std::uint32_t leaf) { look_in(leaf, own, point, best); },
      [&](const ImageTrimRun& run) {
        for (std::uint32_t k = run.first; k < run.first + run.count; ++k)
          look_at(nearest_on(surface_, k, point), own, point, best);
      });
  return best;
}

std::optional<Vec3> MeetingSurface::facing_edge(const SurfacePlace& own, const Vec3& point, const Vec3& normal,
                                                const Vec3& onward) const {
  double reach = kThickest * surface_.half_diagonal();
  std::optional<Vec3> best;
  const std::uint32_t patch = surface_.span(own.span).patch;
  const auto take = [&](const Vec3& way, const std::optional<Vec3>& inward) {
    const bool faces = way.dot(normal) < 0.0 && inward && inward->dot(onward) < 0.0;
    if (!faces || way.norm() >= reach) return;
    reach = way.norm();
    best = way;
  };
  const auto look_at_side = [&](std::uint32_t span, const ParameterLimits& line) {
    const bool own_side = surface_.span(span).patch == patch && ((line.u_min == line.u_max && line.u_min == own.u) ||
                                                                 (line.v_min == line.v_max && line.v_min == own.v));
    if (own_side) return;
    for (int k = 0; k < kLeafParts; ++k) {
      const auto [u_low, u_high] = part_of(line.u_min, line.u_max, k);
      const auto [v_low, v_high] = part_of(line.v_min, line.v_max, k);
      const SurfacePlace start{span, 0.5 * (u_low + u_high), 0.5 * (v_low + v_high)};
      const Projection found = project_local(surface_, point, start, {u_low, u_high, v_low, v_high});
      take(-found.offset, into_patch(found));
    }
  };
  const auto look_in_leaf = [&](std::uint32_t leaf) {
    const ImageLeaf& l = surface_.image().leaves()[leaf];
    if (surface_.patch_of(l.span).slab_count > 0) return;
    const ParameterLimits limits = limits_of(surface_, l);
    for (const double u : {0.0, 1.0}) {
      if (limits.u_min == u || limits.u_max == u) look_at_side(l.span, {u, u, limits.v_min, limits.v_max});
    }
    for (const double v : {0.0, 1.0}) {
      if (limits.v_min == v || limits.v_max == v) look_at_side(l.span, {limits.u_min, limits.u_max, v, v});
    }
  };
  each_near(point, reach, look_in_leaf, [&](const ImageTrimRun& run) {
    for (std::uint32_t k = run.first; k < run.first + run.count; ++k) {
      const TrimPlace found = nearest_on(surface_, k, point);
      const Vec3 way = -found.offset;
      if (way.dot(normal) < -kLeastDepth * way.norm()) take(way, found.inward);
    }
  });
  return best;
}

void MeetingSurface::look_in(std::uint32_t leaf, const SurfacePlace& own, const Vec3& point,
                             std::optional<MeetingPlace>& best) const {
  const ImageLeaf& l = surface_.image().leaves()[leaf];
  if (least_distance(l.bounds, in_frame(l.bounds, point)) > gap_) return;
  const ParameterLimits whole = limits_of(surface_, l);
  for (int k = 0; k < kLeafParts * kLeafParts; ++k) {
    const auto [u_low, u_high] = part_of(whole.u_min, whole.u_max, k / kLeafParts);
    const auto [v_low, v_high] = part_of(whole.v_min, whole.v_max, k % kLeafParts);
    look_in_part(l.span, {u_low, u_high, v_low, v_high}, own, point, best);
  }
}

void MeetingSurface::look_in_part(std::uint32_t span, const ParameterLimits& limits, const SurfacePlace& own,
                                  const Vec3& point, std::optional<MeetingPlace>& best) const {
  const SurfacePlace middle{span, 0.5 * (limits.u_min + limits.u_max), 0.5 * (limits.v_min + limits.v_max)};
  const Projection found = on_edge(surface_, project_local(surface_, point, middle, limits), kOnEdge * gap_);
  const double distance = found.offset.norm();
  if (found.outside || distance > gap_ || (best && distance >= best->rank)) return;
  const bool same_patch = surface_.span(own.span).patch == surface_.span(found.place.span).patch;
  if (same_patch && connected(own, found.place, point)) return;
  best = MeetingPlace{distance, surface_.normal(found.place, found.at), into_patch(found), distance};
}

void MeetingSurface::look_at(const TrimPlace& found, const SurfacePlace& own, const Vec3& point,
                             std::optional<MeetingPlace>& best) const {
  const double distance = found.offset.norm(), rank = distance - kLoopFirst * gap_;
  if (distance > gap_ || (best && rank >= best->rank) || found.inward.isZero()) return;
  const bool same_patch = surface_.span(own.span).patch == surface_.span(found.place.span).patch;
  if (same_patch && connected(own, found.place, point)) return;
  best = MeetingPlace{distance, surface_.normal(found.place, found.at), found.inward, rank};
}

bool MeetingSurface::connected(const SurfacePlace& a, const SurfacePlace& b, const Vec3& point) const {
  for (const double share : {0.25, 0.5, 0.75}) {
    SurfacePlace between{a.span, a.u + share * (b.u - a.u), a.v + share * (b.v - a.v)};
    surface_.settle(between);
    if ((surface_.evaluate(between).s - point).norm() > kNeighbourhood * gap_) return false;
  }
  return true;
}

bool MeetingSurface::reaches(const Vec3& point, const Vec3& direction) const {
  const double way = kWay * gap_;
  const ProjectionQuery query{point + way * direction, Vec3::Zero(), 0.0};
  const Projection found = project_global(surface_, query, nullptr).nearest;
  return found.converged && !found.fixed_u && !found.fixed_v && !found.on_trim() &&
         found.offset.norm() < kFarthest * way;
}

}  // namespace bladefit
