#include "tools/design/leaf_bounding.hpp"

#include <Eigen/Geometry>
#include <limits>

#include "core/geometry/surface.hpp"
#include "tools/design/interval.hpp"

namespace bladefit {
namespace {

/// Pieces in each direction: the intervals' excess falls with their number.
constexpr int kPieces = 2;
/// Widening against rounding, of the size of what is bounded.
constexpr double kWidening = 1e-12;

/// Ranges of a homogeneous quantity over a piece.
struct HomogeneousRange {
  IntervalVector place;
  Interval weight;
};

/// S - origin and its derivatives s, t, ss, st, tt over a piece.
struct PieceRange {
  IntervalVector place;
  std::array<IntervalVector, 5> derivative;
};

constexpr Interval kNothing{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

/// A piece of a span: its net, moved to an origin of its own, and its size in the span's parameters.
class Piece {
 public:
  Piece(const BezierSpan& span, const LocalRect& rect) {
    restrict_net(span.net, span.degree_u, span.degree_v, rect, net_);
    const Homogeneous& corner = net_.at(net_.degree_u / 2, net_.degree_v / 2);
    origin_ = corner.head<3>() / corner[3];
    for (std::uint32_t k = 0; k < (net_.degree_u + 1) * (net_.degree_v + 1); ++k)
      net_.points[k].head<3>() -= net_.points[k][3] * origin_.array();
  }

  [[nodiscard]] const Vec3& origin() const { return origin_; }
  [[nodiscard]] const BezierNet& net() const { return net_; }

  /// Control values of the derivative of order (along_u, along_v): differences, times the factor of the degrees.
  [[nodiscard]] HomogeneousRange derivative(std::uint32_t along_u, std::uint32_t along_v) const {
    if (along_u > net_.degree_u || along_v > net_.degree_v) return HomogeneousRange{};
    BezierNet d = net_;
    double factor = 1.0;
    for (std::uint32_t k = 0; k < along_u; ++k) {
      factor *= (net_.degree_u - k) * static_cast<double>(kPieces);
      for (std::uint32_t i = 0; i < net_.degree_u - k; ++i) {
        for (std::uint32_t j = 0; j <= net_.degree_v; ++j) d.at(i, j) = d.at(i + 1, j) - Homogeneous(d.at(i, j));
      }
    }
    for (std::uint32_t k = 0; k < along_v; ++k) {
      factor *= (net_.degree_v - k) * static_cast<double>(kPieces);
      for (std::uint32_t i = 0; i <= net_.degree_u - along_u; ++i) {
        for (std::uint32_t j = 0; j < net_.degree_v - k; ++j) d.at(i, j) = d.at(i, j + 1) - Homogeneous(d.at(i, j));
      }
    }
    Homogeneous low = Homogeneous::Constant(kNothing.low), high = Homogeneous::Constant(kNothing.high);
    for (std::uint32_t i = 0; i <= net_.degree_u - along_u; ++i) {
      for (std::uint32_t j = 0; j <= net_.degree_v - along_v; ++j) {
        low = low.min(d.at(i, j));
        high = high.max(d.at(i, j));
      }
    }
    low *= factor;
    high *= factor;
    return {{Interval{low[0], high[0]}, {low[1], high[1]}, {low[2], high[2]}}, {low[3], high[3]}};
  }

  /// S - origin: inside the hull of the control points.
  [[nodiscard]] IntervalVector place() const {
    IntervalVector range{kNothing, kNothing, kNothing};
    for (std::uint32_t k = 0; k < (net_.degree_u + 1) * (net_.degree_v + 1); ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double coordinate = net_.points[k][static_cast<Eigen::Index>(axis)] / net_.points[k][3];
        range[axis].include({coordinate, coordinate});
      }
    }
    return range;
  }

 private:
  BezierNet net_;
  Vec3 origin_;
};

/// Quotient rule on A / w with intervals; small because A is taken about the piece's own origin.
PieceRange range_of(const Piece& piece) {
  const HomogeneousRange value = piece.derivative(0, 0), s = piece.derivative(1, 0), t = piece.derivative(0, 1),
                         ss = piece.derivative(2, 0), st = piece.derivative(1, 1), tt = piece.derivative(0, 2);
  const Interval over = inverse(value.weight);
  PieceRange out;
  out.place = piece.place();
  if (value.weight.low == value.weight.high) {
    out.derivative = {over * s.place, over * t.place, over * ss.place, over * st.place, over * tt.place};
    return out;
  }
  out.derivative[0] = over * (s.place - s.weight * out.place);
  out.derivative[1] = over * (t.place - t.weight * out.place);
  const IntervalVector &d_s = out.derivative[0], &d_t = out.derivative[1];
  out.derivative[2] = over * (ss.place - (2.0 * s.weight) * d_s - ss.weight * out.place);
  out.derivative[3] = over * (st.place - s.weight * d_t - t.weight * d_s - st.weight * out.place);
  out.derivative[4] = over * (tt.place - (2.0 * t.weight) * d_t - tt.weight * out.place);
  return out;
}

IntervalVector in_frame(const double (&axis)[3][3], const IntervalVector& a) {
  IntervalVector out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = axis[k][0] * a[0] + axis[k][1] * a[1] + axis[k][2] * a[2];
  return out;
}

/// The derivatives aa, ab, bb from ss, st, tt.
std::array<IntervalVector, 3> stretched(const double (&stretch)[3], const IntervalVector& ss, const IntervalVector& st,
                                        const IntervalVector& tt) {
  const double alpha = stretch[0], beta = stretch[1], gamma = stretch[2];
  return {(alpha * alpha) * ss, (alpha * beta) * st + (alpha * gamma) * ss,
          (beta * beta) * tt + (2.0 * beta * gamma) * st + (gamma * gamma) * ss};
}

/// Derivatives s, t, aa, ab, bb of 1/2 |S - c|^2 from S - c and the derivatives of S.
std::array<Interval, 5> self_range(const double (&stretch)[3], const IntervalVector& arm,
                                   const std::array<IntervalVector, 5>& d) {
  const IntervalVector along_a = stretch[0] * d[0];
  const IntervalVector along_b = stretch[1] * d[1] + stretch[2] * d[0];
  return {dot(arm, d[0]), dot(arm, d[1]), square_sum(along_a) + dot(arm, d[2]), dot(along_a, along_b) + dot(arm, d[3]),
          square_sum(along_b) + dot(arm, d[4])};
}

/// The frame: normal, direction of Ss, and the third; the coordinate axes where the parametrisation is degenerate.
void set_frame(const SurfacePoint& middle, ImageBounds& bounds) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  bounds.stretch[0] = bounds.stretch[1] = 1.0;
  bounds.stretch[2] = 0.0;
  const Vec3 normal = middle.s_u.cross(middle.s_v);
  if (normal.norm() > 1e-6 * middle.s_u.norm() * middle.s_v.norm()) {
    const Vec3 along = middle.s_u.normalized();
    axes.row(0) = normal.normalized();
    axes.row(1) = along;
    axes.row(2) = normal.normalized().cross(along);
    const Vec3 across = axes.row(2);
    bounds.stretch[0] = 1.0 / middle.s_u.norm();
    bounds.stretch[1] = 1.0 / across.dot(middle.s_v);
    bounds.stretch[2] = -bounds.stretch[0] * bounds.stretch[1] * along.dot(middle.s_v);
  }
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) bounds.axis[k][j] = axes(k, j);
  }
}

void set_middle(const SurfacePoint& middle, ImageBounds& bounds) {
  set_frame(middle, bounds);
  const double alpha = bounds.stretch[0], beta = bounds.stretch[1], gamma = bounds.stretch[2];
  const Vec3 derivatives[5] = {
      middle.s_u, middle.s_v, alpha * alpha * middle.s_uu, alpha * beta * middle.s_uv + alpha * gamma * middle.s_uu,
      beta * beta * middle.s_vv + 2.0 * beta * gamma * middle.s_uv + gamma * gamma * middle.s_uu};
  for (int k = 0; k < 3; ++k) {
    bounds.middle[k] = middle.s[k];
    bounds.low[k] = kNothing.low;
    bounds.high[k] = kNothing.high;
    for (int d = 0; d < 5; ++d) {
      bounds.derivative[d][k] = Vec3(bounds.axis[k]).dot(derivatives[d]);
      bounds.spread[d][k] = 0.0;
    }
  }
  for (int d = 0; d < 5; ++d) {
    bounds.self_low[d] = kNothing.low;
    bounds.self_high[d] = kNothing.high;
  }
}

void include_box(const Piece& piece, const Vec3& middle, ImageBounds& bounds) {
  const Vec3 shift = piece.origin() - middle;
  for (std::uint32_t n = 0; n < (piece.net().degree_u + 1) * (piece.net().degree_v + 1); ++n) {
    const Homogeneous& point = piece.net().points[n];
    const Vec3 arm = Vec3(point.head<3>() / point[3]) + shift;
    for (int k = 0; k < 3; ++k) {
      const double along = Vec3(bounds.axis[k]).dot(arm);
      bounds.low[k] = std::min(bounds.low[k], along);
      bounds.high[k] = std::max(bounds.high[k], along);
    }
  }
}

void include_piece(const Piece& piece, ImageBounds& bounds) {
  const Vec3 middle(bounds.middle);
  include_box(piece, middle, bounds);
  PieceRange range = range_of(piece);
  const Vec3 shift = piece.origin() - middle;
  for (std::size_t k = 0; k < 3; ++k) range.place[k] = range.place[k] + shift[static_cast<Eigen::Index>(k)];
  const IntervalVector arm = in_frame(bounds.axis, range.place);
  for (IntervalVector& derivative : range.derivative) derivative = in_frame(bounds.axis, derivative);
  const std::array<IntervalVector, 3> second =
      stretched(bounds.stretch, range.derivative[2], range.derivative[3], range.derivative[4]);
  std::copy(second.begin(), second.end(), range.derivative.begin() + 2);
  const std::array<Interval, 5> self = self_range(bounds.stretch, arm, range.derivative);
  for (std::size_t d = 0; d < 5; ++d) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double farthest = (range.derivative[d][k] + -bounds.derivative[d][k]).magnitude();
      bounds.spread[d][k] = std::max(bounds.spread[d][k], farthest);
    }
    bounds.self_low[d] = std::min(bounds.self_low[d], self[d].low);
    bounds.self_high[d] = std::max(bounds.self_high[d], self[d].high);
  }
}

void widen(double (&low)[3], double (&high)[3], double by) {
  for (int k = 0; k < 3; ++k) {
    low[k] -= by;
    high[k] += by;
  }
}

}  // namespace

ImageBounds leaf_bounds(const BezierSpan& span, const LocalRect& rect) {
  const auto at_s = [&](double x) { return rect.s_min + x * (rect.s_max - rect.s_min); };
  const auto at_t = [&](double x) { return rect.t_min + x * (rect.t_max - rect.t_min); };
  HomogeneousDerivatives h;
  evaluate_taylor(span.taylor, span.degree_u, span.degree_v, at_s(0.5) - 0.5, at_t(0.5) - 0.5, h);
  ImageBounds bounds;
  set_middle(scaled(projected(h), rect.s_max - rect.s_min, rect.t_max - rect.t_min), bounds);
  const auto piece = [&](int i, int j) {
    const double d = 1.0 / kPieces;
    return Piece(span, {at_s(i * d), at_s((i + 1) * d), at_t(j * d), at_t((j + 1) * d)});
  };
  for (int k = 0; k < kPieces * kPieces; ++k) include_piece(piece(k / kPieces, k % kPieces), bounds);
  double size = Vec3(bounds.middle).norm();
  for (int k = 0; k < 3; ++k) size += bounds.high[k] - bounds.low[k];
  widen(bounds.low, bounds.high, kWidening * size);
  for (int d = 0; d < 5; ++d) {
    const double derivative = Vec3(bounds.derivative[d]).norm();
    for (double& spread : bounds.spread[d]) spread += kWidening * (derivative + spread);
    const double by = kWidening * (size * derivative + std::abs(bounds.self_low[d]) + std::abs(bounds.self_high[d]));
    bounds.self_low[d] -= by;
    bounds.self_high[d] += by;
  }
  return bounds;
}

}  // namespace bladefit
