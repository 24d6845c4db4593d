#include "core/geometry/global_projection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/distance_certificate.hpp"

namespace bladefit {
namespace {

/// Answers are proven to within this [half diagonals].
constexpr double kSlack = 1e-10;
/// A local minimum whose normal is this near to facing the probe [rad] may come to face it while the point is tracked.
constexpr double kAlmostFacing = 0.05;
/// Local minima this near to each other are one [half diagonals].
constexpr double kSameFoot = 1e-7;
/// Rectangles are not cut below 2^-kMaxCuts of a span.
constexpr std::uint32_t kMaxCuts = 60;

double box_distance(const ImageNode& node, const Vec3& r) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double d = std::max({node.box_min[k] - r[k], r[k] - node.box_max[k], 0.0});
    sum += d * d;
  }
  return std::sqrt(sum);
}

struct Piece {
  LocalRect rect;
  std::uint32_t cuts = 0;
  [[nodiscard]] PieceShape shape() const { return {rect.s_min < rect.s_max, rect.t_min < rect.t_max}; }
};

/// What is to be done with a piece.
enum class Fate : std::uint8_t { settled, cut, shrunk };

class Search {
 public:
  Search(const Surface& surface, const ProjectionQuery& query)
      : surface_(surface),
        query_(query),
        directed_(query.approach.squaredNorm() > 0.5),
        slack_(kSlack * surface.half_diagonal()) {}

  void consider(const Projection& candidate) {
    if (!candidate.converged) {
      // Where no local minimum can be told, at a centre of curvature, the nearest place seen is the answer.
      const bool nearer = !has_resort_ || candidate.distance_squared() < resort_.distance_squared();
      if (nearer) resort_ = candidate;
      has_resort_ = true;
      return;
    }
    const double distance = std::sqrt(candidate.distance_squared());
    if (directed_) {
      const double facing = surface_.normal(candidate.place, candidate.at).dot(query_.approach);
      if (facing >= 0.0 && facing < kAlmostFacing) rival_distance_ = std::min(rival_distance_, distance);
      if (facing >= 0.0) return;
    }
    const bool same = found_ && (candidate.at.s - result_.nearest.at.s).norm() <= kSameFoot * surface_.half_diagonal();
    if (found_ && distance >= best_distance_) {
      if (!same) rival_distance_ = std::min(rival_distance_, distance);
      return;
    }
    if (found_ && !same) rival_distance_ = best_distance_;
    result_.nearest = candidate;
    best_distance_ = distance;
    found_ = true;
  }

  /// Depth first, the nearer child first.
  void run() {
    struct Entry {
      std::uint32_t node;
      double distance;
    };
    const auto nodes = surface_.image().nodes();
    std::array<Entry, kMaxTreeDepth + 1> stack;
    std::size_t size = 0;
    stack[size++] = {0, box_distance(nodes[0], query_.point)};
    while (size > 0 && !exhausted_) {
      const Entry entry = stack[--size];
      if (found_ && entry.distance >= reach() - slack_) continue;
      const ImageNode& node = nodes[entry.node];
      if (node.right == 0) {
        search_span(node.span);
        continue;
      }
      Entry near{entry.node + 1, box_distance(nodes[entry.node + 1], query_.point)};
      Entry far{node.right, box_distance(nodes[node.right], query_.point)};
      if (far.distance < near.distance) std::swap(near, far);
      stack[size++] = far;
      stack[size++] = near;
    }
  }

  [[nodiscard]] bool found() const { return found_; }
  [[nodiscard]] GlobalProjection result() const {
    GlobalProjection out = result_;
    if (!found_ && has_resort_) out.nearest = resort_;
    out.proven = found_ && !exhausted_;
    out.lead = out.proven ? std::max(0.0, std::min(rival_distance_, reach()) - best_distance_) : 0.0;
    return out;
  }

 private:
  /// Nothing beyond this distance matters.
  [[nodiscard]] double reach() const { return best_distance_ + query_.margin; }

  /// No normal of the span faces the probe.
  [[nodiscard]] bool averted(const ImageSpan& span) const {
    if (!directed_ || span.cone_cosine <= 0.0) return false;
    const double along = span.cone_axis[0] * query_.approach[0] + span.cone_axis[1] * query_.approach[1] +
                         span.cone_axis[2] * query_.approach[2];
    const double across = std::sqrt(std::max(0.0, 1.0 - along * along));
    const double sine = std::sqrt(1.0 - span.cone_cosine * span.cone_cosine);
    return along > 0.0 && along * span.cone_cosine - across * sine > kAlmostFacing;
  }

  [[nodiscard]] SurfacePlace middle(std::uint32_t span, const LocalRect& rect) const {
    const SpanDomain d = surface_.domain(span);
    return {span, d.u_min + 0.5 * (rect.s_min + rect.s_max) * (d.u_max - d.u_min),
            d.v_min + 0.5 * (rect.t_min + rect.t_max) * (d.v_max - d.v_min)};
  }

  [[nodiscard]] ParameterLimits limits_of(std::uint32_t span, const LocalRect& rect) const {
    const SpanDomain d = surface_.domain(span);
    const auto at = [](double low, double high, double x) {
      return x <= 0.0 ? low : x >= 1.0 ? high : low + x * (high - low);
    };
    return {at(d.u_min, d.u_max, rect.s_min), at(d.u_min, d.u_max, rect.s_max), at(d.v_min, d.v_max, rect.t_min),
            at(d.v_min, d.v_max, rect.t_max)};
  }

  void search_span(std::uint32_t span) {
    if (averted(surface_.span(span))) return;
    const ImagePatch& patch = surface_.patch_of(span);
    BezierNet net;
    restrict_net(surface_.net(span), patch.degree_u, patch.degree_v, {}, net);
    const DistanceRange range = distance_range(net, query_.point);
    if (found_ && range.least >= reach() - slack_) return;
    // A good best early spares most of the proof.
    if (!found_ || range.middle < best_distance_) consider(project_local(surface_, query_.point, middle(span, {})));
    std::array<Piece, kMaxCuts + 2> stack;
    std::size_t size = 0;
    stack[size++] = {};
    while (size > 0) {
      if (++result_.pieces > kMaxPieces) {
        exhausted_ = true;
        return;
      }
      Piece& piece = stack[size - 1];
      restrict_net(surface_.net(span), patch.degree_u, patch.degree_v, piece.rect, net);
      const Fate fate = examine(span, piece, net);
      if (fate == Fate::shrunk) continue;
      --size;
      if (fate == Fate::settled) continue;
      if (piece.cuts >= kMaxCuts) {
        exhausted_ = true;
        continue;
      }
      cut(net, Piece(piece), stack[size], stack[size + 1]);
      size += 2;
    }
  }

  /// settled: nothing in the piece can better the best, or its only minimum was found and considered. shrunk: the piece
  /// was reduced to the edge of the patch on which its minimum lies.
  Fate examine(std::uint32_t span, Piece& piece, const BezierNet& net) {
    const DistanceRange range = distance_range(net, query_.point);
    if (found_ && range.least >= reach() - slack_) return Fate::settled;
    const double bound = found_ ? std::min(reach(), range.most) : range.most;
    const DistanceForm form(net, query_.point, bound);
    if (found_ && bound == reach() && form.farther(slack_ * (2.0 * bound + slack_))) return Fate::settled;
    MinimumProof proof = form.proof(piece.shape());
    if (surface_.patch_of(span).rational != 0)
      proof = common(proof, DistanceForm(net, query_.point, range.least).proof(piece.shape()));

    const ParameterLimits limits = limits_of(span, piece.rect);
    if (proof.no_minimum && inside_patch(limits, piece.shape())) return Fate::settled;
    if (falls_out(limits, proof)) return Fate::settled;
    if (shrink(piece.rect, proof)) return Fate::shrunk;
    if (!proof.convex) return Fate::cut;
    const Projection least = project_local(surface_, query_.point, start_in(span, limits, piece.rect), limits);
    if (!least.converged) return Fate::cut;
    // Held at an inner side, it falls towards a neighbouring piece, which will find it.
    if (!held_inside(least, limits)) consider(least);
    return Fate::settled;
  }

  /// What two bounds prove together.
  static MinimumProof common(const MinimumProof& a, const MinimumProof& b) {
    return {a.monotone_u == b.monotone_u ? a.monotone_u : 0, a.monotone_v == b.monotone_v ? a.monotone_v : 0,
            a.no_minimum && b.no_minimum, a.convex && b.convex};
  }

  /// No end of the piece, in the directions it has, is on an edge of the patch.
  [[nodiscard]] static bool inside_patch(const ParameterLimits& l, PieceShape shape) {
    const bool u = !shape.along_u || (l.u_min > 0.0 && l.u_max < 1.0);
    const bool v = !shape.along_v || (l.v_min > 0.0 && l.v_max < 1.0);
    return u && v;
  }

  /// The distance falls everywhere towards a side that is no edge of the patch: no local minimum here.
  [[nodiscard]] static bool falls_out(const ParameterLimits& limits, const MinimumProof& c) {
    const bool u = (c.monotone_u > 0 && limits.u_min > 0.0) || (c.monotone_u < 0 && limits.u_max < 1.0);
    const bool v = (c.monotone_v > 0 && limits.v_min > 0.0) || (c.monotone_v < 0 && limits.v_max < 1.0);
    return u || v;
  }

  /// The distance falls everywhere towards an edge of the patch: only that edge is left to be searched.
  [[nodiscard]] static bool shrink(LocalRect& rect, const MinimumProof& c) {
    if (c.monotone_u != 0) rect.s_min = rect.s_max = c.monotone_u > 0 ? rect.s_min : rect.s_max;
    if (c.monotone_v != 0) rect.t_min = rect.t_max = c.monotone_v > 0 ? rect.t_min : rect.t_max;
    return c.monotone_u != 0 || c.monotone_v != 0;
  }

  /// Where the best foot lies in the piece's span, start from there: then one or two evaluations confirm it.
  [[nodiscard]] SurfacePlace start_in(std::uint32_t span, const ParameterLimits& limits, const LocalRect& rect) const {
    if (!found_ || result_.nearest.place.span != span) return middle(span, rect);
    const SurfacePlace& best = result_.nearest.place;
    return {span, std::clamp(best.u, limits.u_min, limits.u_max), std::clamp(best.v, limits.v_min, limits.v_max)};
  }

  /// Held at a limit beyond which the patch goes on.
  [[nodiscard]] static bool held_inside(const Projection& p, const ParameterLimits& limits) {
    const auto goes_on = [&p](const Vec3& tangent, double low, double high) {
      return p.offset.dot(tangent) > 0.0 ? high < 1.0 : low > 0.0;  // the distance falls towards that end
    };
    return (p.fixed_u && goes_on(p.at.s_u, limits.u_min, limits.u_max)) ||
           (p.fixed_v && goes_on(p.at.s_v, limits.v_min, limits.v_max));
  }

  /// Halves the piece across its longer side.
  static void cut(const BezierNet& net, const Piece& piece, Piece& first, Piece& second) {
    const auto place = [](const Homogeneous& h) { return Vec3(h.head<3>() / h[3]); };
    const Vec3 a = place(net.at(0, 0)), b = place(net.at(net.degree_u, 0)), c = place(net.at(0, net.degree_v)),
               d = place(net.at(net.degree_u, net.degree_v));
    const bool along_u = (b - a).squaredNorm() + (d - c).squaredNorm() >= (c - a).squaredNorm() + (d - b).squaredNorm();
    first = second = {piece.rect, piece.cuts + 1};
    if (along_u) {
      first.rect.s_max = second.rect.s_min = 0.5 * (piece.rect.s_min + piece.rect.s_max);
    } else {
      first.rect.t_max = second.rect.t_min = 0.5 * (piece.rect.t_min + piece.rect.t_max);
    }
  }

  const Surface& surface_;
  const ProjectionQuery& query_;
  bool directed_;
  double slack_;
  bool found_ = false;
  bool exhausted_ = false;
  double best_distance_ = 0.0;
  double rival_distance_ = INFINITY;
  GlobalProjection result_;
  bool has_resort_ = false;
  Projection resort_;  ///< the nearest place that is not a proper minimum
};

GlobalProjection search(const Surface& surface, const ProjectionQuery& query, const Projection* hint) {
  Search search(surface, query);
  if (hint != nullptr) search.consider(*hint);
  search.run();
  return search.result();
}

}  // namespace

bool faces_probe(const Surface& surface, const Projection& projection, const Vec3& approach) {
  if (approach.squaredNorm() < 0.5) return true;
  return surface.normal(projection.place, projection.at).dot(approach) < 0.0;
}

GlobalProjection project_global(const Surface& surface, const ProjectionQuery& query, const Projection* hint) {
  GlobalProjection directed = search(surface, query, hint);
  if (directed.nearest.converged || query.approach.isZero()) return directed;
  const ProjectionQuery undirected{query.point, Vec3::Zero(), query.margin};
  GlobalProjection any = search(surface, undirected, hint);
  any.proven = any.proven && directed.pieces <= kMaxPieces;
  any.pieces += directed.pieces;
  any.faces = false;
  return any;
}

}  // namespace bladefit
