#include "core/geometry/nearest/leaf_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/nearest/collapsed_side.hpp"
#include "core/geometry/nearest/distance_certificate.hpp"
#include "core/geometry/nearest/leaf_bounds.hpp"

namespace bladefit {
namespace {

/// Rectangles are not cut below 2^-kMaxCuts of a span.
constexpr std::uint32_t kMaxCuts = 60;
/// Pieces of one leaf: one that lies at a centre of curvature must not use up the others' share.
constexpr std::uint32_t kMaxLeafPieces = 1024;
/// A piece at a pole is cut off at this share of the extent at which all of it is one foot: it is not straight.
constexpr double kFootShare = 1.0 / 32.0;

struct Piece {
  LocalRect rect;
  std::uint32_t cuts = 0;
  [[nodiscard]] PieceShape shape() const { return {rect.s_min < rect.s_max, rect.t_min < rect.t_max}; }
};

/// What is to be done with a piece.
enum class Fate : std::uint8_t { settled, cut, shrunk };

class LeafSearch {
 public:
  LeafSearch(const Surface& surface, const ProjectionQuery& query, const ImageLeaf& leaf, NearestSoFar& nearest)
      : surface_(surface),
        query_(query),
        leaf_(leaf),
        index_(leaf.span),
        span_(surface.span(index_)),
        patch_(surface.patch_of(index_)),
        domain_(surface.domain(index_)),
        arm_(in_frame(leaf.bounds, query.point)),
        nearest_(nearest) {}

  LeafOutcome run(std::uint32_t budget) {
    if (least_distance(leaf_.bounds, arm_) >= nearest_.limit() || averted()) return {};
    Piece piece{rect_of(leaf_)};
    if (nearest_.takes_start()) nearest_.consider(project_local(surface_, query_.point, start_in(piece.rect)));
    if (ends_of(piece.rect) == 0 && slopes_across(leaf_.bounds, arm_)) return {};
    const DerivativeRanges ranges = derivative_ranges(leaf_.bounds, arm_);
    Fate fate = Fate::shrunk;
    // A piece has two directions to lose.
    for (int k = 0; k < 3 && fate == Fate::shrunk; ++k) {
      const PieceShape shape = piece.shape();
      const MinimumProof proof = prove(shape.along_u ? ranges : ranges_along_t(leaf_.bounds, ranges), shape);
      if (proof.convex && shape.along_u && shape.along_v && beyond_limit(piece.rect)) return {};
      fate = decide(piece, proof);
    }
    if (fate == Fate::settled) return {};
    return search_pieces(piece, std::min(budget, kMaxLeafPieces));
  }

 private:
  /// No normal of the span faces the probe.
  [[nodiscard]] bool averted() const {
    if (!nearest_.directed() || span_.cone_cosine <= 0.0) return false;
    const double along = Vec3(span_.cone_axis).dot(query_.approach);
    if (along <= 0.0) return false;
    const double across = std::sqrt(std::max(0.0, 1.0 - along * along));
    const double sine = std::sqrt(1.0 - span_.cone_cosine * span_.cone_cosine);
    return along * span_.cone_cosine - across * sine > kAlmostFacing;
  }

  LeafOutcome search_pieces(const Piece& first, std::uint32_t budget) {
    LeafOutcome outcome;
    poles_ = poles_of(surface_, index_, foot_size());
    std::array<Piece, kMaxCuts + 2> stack;
    std::size_t size = 0;
    stack[size++] = first;
    while (size > 0) {
      if (outcome.pieces == budget) {
        outcome.exhausted = true;
        return outcome;
      }
      ++outcome.pieces;
      Piece& piece = stack[size - 1];
      surface_.net(index_, net_);
      restrict_net(piece.rect, net_);
      const Fate fate = examine(piece);
      if (fate == Fate::shrunk) continue;
      --size;
      if (fate == Fate::settled) continue;
      if (piece.cuts >= kMaxCuts) {
        outcome.exhausted = true;
        continue;
      }
      cut(Piece(piece), stack[size], stack[size + 1]);
      size += 2;
    }
    return outcome;
  }

  Fate examine(Piece& piece) {
    const DistanceRange range = distance_range(net_, query_.point);
    const double limit = nearest_.limit();
    if (range.least >= limit) return Fate::settled;
    const double bound = std::min(limit, range.most);
    const DistanceForm form(net_, query_.point, bound);
    if (bound == limit && form.farther(nearest_.slack() * (2.0 * bound + nearest_.slack()))) return Fate::settled;
    if (poles_.any() && is_one_foot(piece.rect, range.least)) return Fate::settled;
    DerivativeRanges ranges = form.ranges();
    if (patch_.rational != 0) ranges = hull(ranges, distance_ranges(net_, query_.point, range.least));
    return decide(piece, prove(ranges, piece.shape()));
  }

  /// About a pole nothing is convex. There a piece that is so small that all of its minima are one foot is settled
  /// where it is no nearer than the nearest; else it is a start, from which the nearest may be found.
  bool is_one_foot(const LocalRect& rect, double least) {
    if (extent_of(net_) > foot_size()) return false;
    const Projection found = project_local(surface_, query_.point, start_in(rect));
    nearest_.consider(found);
    if (least < nearest_.least_that_matters()) return false;
    Projection about = found;
    about.place = start_in(rect);
    about.at = surface_.evaluate(about.place);
    nearest_.consider_possible(about, least);
    return true;
  }

  /// settled: nothing in the piece can matter, or its only minimum was considered. shrunk: the piece was reduced to the
  /// edge on which its minimum lies.
  Fate decide(Piece& piece, const MinimumProof& proof) {
    const std::uint32_t ends = ends_of(piece.rect);
    if (proof.no_minimum && inside(ends, piece.shape())) return Fate::settled;
    if (falls_out(ends, proof)) return Fate::settled;
    if (shrink(piece.rect, proof)) return Fate::shrunk;
    if (!proof.convex) return Fate::cut;
    if (holds_nearest(piece.rect)) return Fate::settled;
    const Projection least = project_local(surface_, query_.point, start_in(piece.rect), limits_of(piece.rect));
    if (!least.converged) return Fate::cut;
    // Held at an inner side, it falls towards a neighbouring piece, which will find it.
    if (!held_inside(least, piece.rect)) nearest_.consider(least);
    return Fate::settled;
  }

  /// Half the squared distance, convex over the rectangle, lies above its tangent planes, and one of these nowhere
  /// below the limit. Cost: three evaluations at most; where the nearest is just beyond a side, they save the way to
  /// the least on that side.
  [[nodiscard]] bool beyond_limit(const LocalRect& rect) const {
    if (!nearest_.found() || holds_nearest(rect)) return false;
    const ParameterLimits limits = limits_of(rect);
    const double enough = nearest_.limit() * nearest_.limit();
    SurfacePlace place = start_in(rect);
    for (int k = 0; k < 3; ++k) {
      const SurfacePoint at = surface_.evaluate(place);
      const Vec3 offset = at.s - query_.point;
      const double square = offset.squaredNorm();
      if (square < enough) return false;
      const double slope_u = offset.dot(at.s_u), slope_v = offset.dot(at.s_v);
      const double fall = std::min(slope_u * (limits.u_min - place.u), slope_u * (limits.u_max - place.u)) +
                          std::min(slope_v * (limits.v_min - place.v), slope_v * (limits.v_max - place.v));
      if (square + 2.0 * fall >= enough) return true;
      // Along the side that it is held at.
      const bool held_u = (place.u <= limits.u_min && slope_u > 0.0) || (place.u >= limits.u_max && slope_u < 0.0);
      const bool held_v = (place.v <= limits.v_min && slope_v > 0.0) || (place.v >= limits.v_max && slope_v < 0.0);
      if (held_u == held_v) return false;
      const double bend_u = at.s_u.squaredNorm() + offset.dot(at.s_uu),
                   bend_v = at.s_v.squaredNorm() + offset.dot(at.s_vv);
      if (held_u) place.v = std::clamp(place.v - slope_v / bend_v, limits.v_min, limits.v_max);
      if (held_v) place.u = std::clamp(place.u - slope_u / bend_u, limits.u_min, limits.u_max);
    }
    return false;
  }

  /// Sides of the piece beyond which the surface ends.
  [[nodiscard]] std::uint32_t ends_of(const LocalRect& r) const {
    const std::uint32_t sides = (r.s_min <= 0.0 ? kEndsAtLowU : 0U) | (r.s_max >= 1.0 ? kEndsAtHighU : 0U) |
                                (r.t_min <= 0.0 ? kEndsAtLowV : 0U) | (r.t_max >= 1.0 ? kEndsAtHighV : 0U);
    return span_.ends & sides;
  }

  /// The surface ends at no side of the piece, in the directions it has.
  [[nodiscard]] static bool inside(std::uint32_t ends, PieceShape shape) {
    return (!shape.along_u || (ends & (kEndsAtLowU | kEndsAtHighU)) == 0) &&
           (!shape.along_v || (ends & (kEndsAtLowV | kEndsAtHighV)) == 0);
  }

  /// The distance falls everywhere towards a side beyond which the surface goes on: no local minimum here.
  [[nodiscard]] static bool falls_out(std::uint32_t ends, const MinimumProof& c) {
    const auto goes_on = [ends](int monotone, std::uint32_t low, std::uint32_t high) {
      return (monotone > 0 && (ends & low) == 0) || (monotone < 0 && (ends & high) == 0);
    };
    return goes_on(c.monotone_u, kEndsAtLowU, kEndsAtHighU) || goes_on(c.monotone_v, kEndsAtLowV, kEndsAtHighV);
  }

  /// The distance falls everywhere towards an end of the surface: only that edge is left to be searched.
  [[nodiscard]] static bool shrink(LocalRect& rect, const MinimumProof& c) {
    if (c.monotone_u != 0) rect.s_min = rect.s_max = c.monotone_u > 0 ? rect.s_min : rect.s_max;
    if (c.monotone_v != 0) rect.t_min = rect.t_max = c.monotone_v > 0 ? rect.t_min : rect.t_max;
    return c.monotone_u != 0 || c.monotone_v != 0;
  }

  /// The nearest minimum so far lies in the convex piece: it is its only one.
  [[nodiscard]] bool holds_nearest(const LocalRect& rect) const {
    if (!nearest_.found() || nearest_.nearest().place.span != index_ || nearest_.nearest().on_trim()) return false;
    const SurfacePlace& place = nearest_.nearest().place;
    const ParameterLimits limits = limits_of(rect);
    return place.u >= limits.u_min && place.u <= limits.u_max && place.v >= limits.v_min && place.v <= limits.v_max;
  }

  [[nodiscard]] ParameterLimits limits_of(const LocalRect& rect) const {
    const auto at = [](double low, double high, double x) {
      return x <= 0.0 ? low : x >= 1.0 ? high : low + x * (high - low);
    };
    return {at(domain_.u_min, domain_.u_max, rect.s_min), at(domain_.u_min, domain_.u_max, rect.s_max),
            at(domain_.v_min, domain_.v_max, rect.t_min), at(domain_.v_min, domain_.v_max, rect.t_max)};
  }

  /// A start inside the rectangle: the best foot where it lies in this span, else one Newton step from the middle of
  /// the leaf.
  [[nodiscard]] SurfacePlace start_in(const LocalRect& rect) const {
    const ParameterLimits limits = limits_of(rect);
    SurfacePlace start{index_, 0.0, 0.0};
    if (nearest_.found() && nearest_.nearest().place.span == index_) {
      start = nearest_.nearest().place;
    } else {
      const LocalPlace guess = first_guess(leaf_.bounds, arm_);
      const LocalRect leaf = rect_of(leaf_);
      const double s = leaf.s_min + guess.s * (leaf.s_max - leaf.s_min);
      const double t = leaf.t_min + guess.t * (leaf.t_max - leaf.t_min);
      start.u = domain_.u_min + s * (domain_.u_max - domain_.u_min);
      start.v = domain_.v_min + t * (domain_.v_max - domain_.v_min);
    }
    return {index_, std::clamp(start.u, limits.u_min, limits.u_max), std::clamp(start.v, limits.v_min, limits.v_max)};
  }

  /// Held at a side beyond which the surface goes on.
  [[nodiscard]] bool held_inside(const Projection& p, const LocalRect& rect) const {
    const std::uint32_t ends = ends_of(rect);
    const auto goes_on = [&](const Vec3& tangent, std::uint32_t low, std::uint32_t high) {
      return (ends & (p.offset.dot(tangent) > 0.0 ? high : low)) == 0;  // the distance falls towards that side
    };
    return (p.fixed_u && goes_on(p.at.s_u, kEndsAtLowU, kEndsAtHighU)) ||
           (p.fixed_v && goes_on(p.at.s_v, kEndsAtLowV, kEndsAtHighV));
  }

  /// Cuts the piece that net_ is of across its longer side: in halves, or about a pole where pole_cut() says.
  void cut(const Piece& piece, Piece& first, Piece& second) const {
    const auto place = [](const Homogeneous& h) { return Vec3(h.head<3>() / h[3]); };
    const Vec3 a = place(net_.at(0, 0)), b = place(net_.at(net_.degree_u, 0)), c = place(net_.at(0, net_.degree_v)),
               d = place(net_.at(net_.degree_u, net_.degree_v));
    const bool along_u = (b - a).squaredNorm() + (d - c).squaredNorm() >= (c - a).squaredNorm() + (d - b).squaredNorm();
    first = second = {piece.rect, piece.cuts + 1};
    if (along_u) {
      first.rect.s_max = second.rect.s_min = cut_between(piece.rect.s_min, piece.rect.s_max, poles_.u);
    } else {
      first.rect.t_max = second.rect.t_min = cut_between(piece.rect.t_min, piece.rect.t_max, poles_.v);
    }
  }

  [[nodiscard]] double cut_between(double low, double high, PoleEnd pole) const {
    if (pole == PoleEnd::none) return 0.5 * (low + high);
    const double share = kFootShare * foot_size() / extent_of(net_);
    return pole == PoleEnd::low ? pole_cut(low, high, share) : 1.0 - pole_cut(1.0 - high, 1.0 - low, share);
  }

  /// Local minima this near to each other are one [mm].
  [[nodiscard]] double foot_size() const { return kSameFoot * surface_.half_diagonal(); }

  const Surface& surface_;
  const ProjectionQuery& query_;
  const ImageLeaf& leaf_;
  std::uint32_t index_;  ///< of its span
  const ImageSpan& span_;
  const ImagePatch& patch_;
  SpanDomain domain_;
  Vec3 arm_;  ///< the point in the frame of the leaf
  NearestSoFar& nearest_;
  BezierNet net_;  ///< of the piece in hand
  SpanPoles poles_;
};

}  // namespace

LeafOutcome search_leaf(const Surface& surface, const ProjectionQuery& query, std::uint32_t leaf, std::uint32_t budget,
                        NearestSoFar& nearest) {
  return LeafSearch(surface, query, surface.image().leaves()[leaf], nearest).run(budget);
}

}  // namespace bladefit
