#include "tools/design/image/leaf_bounding.hpp"

#include <Eigen/Geometry>
#include <limits>

#include "core/geometry/surface/surface.hpp"
#include "tools/design/image/framed_piece.hpp"
#include "tools/design/image/leaf_packing.hpp"

namespace bladefit {
namespace {

/// Pieces in each direction: the intervals' excess falls with their number.
constexpr int kPieces = 2;
/// Widening against rounding, of the size of what is bounded.
constexpr double kWidening = 1e-12;

/// A stretch is no more than this, so that second derivatives stay numbers of single precision [1/mm].
constexpr double kMostStretch = 1e12;

/// Those of the bounds: s, t, aa, ab, bb, across s, across t.
template <class Value>
using Derivatives = std::array<Value, kDerivatives>;

/// The unit vector across the sides of constant s in the middle: along_s * Ss + along_t * St. That across those of
/// constant t is Sb.
struct AcrossS {
  double along_s, along_t;
  explicit AcrossS(const SurfacePoint& middle) {
    const double square = middle.s_v.squaredNorm(), share = square > 0.0 ? middle.s_u.dot(middle.s_v) / square : 0.0;
    const double length = (middle.s_u - share * middle.s_v).norm();
    along_s = length * kMostStretch > 1.0 ? 1.0 / length : 1.0;
    along_t = -share * along_s;
  }
};

/// The derivatives of the bounds from s, t, ss, st, tt. `Value`: an interval or a vector.
template <class Value>
Derivatives<Value> stretched(const double (&stretch)[3], const AcrossS& across, const std::array<Value, 5>& d) {
  const double alpha = stretch[0], beta = stretch[1], gamma = stretch[2];
  const auto& [s, t, ss, st, tt] = d;
  return {s,
          t,
          (alpha * alpha) * ss,
          (alpha * beta) * st + (alpha * gamma) * ss,
          (beta * beta) * tt + (2.0 * beta * gamma) * st + (gamma * gamma) * ss,
          across.along_s * s + across.along_t * t,
          beta * t + gamma * s};
}

/// The frame: normal, direction of Ss, or of St where the leaf is hair-thin and lies along that, and the third; the
/// coordinate axes where the parametrisation is degenerate.
void set_frame(const SurfacePoint& middle, LeafBounds& bounds) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  bounds.stretch[0] = bounds.stretch[1] = 1.0;
  bounds.stretch[2] = 0.0;
  const Vec3 normal = middle.s_u.cross(middle.s_v);
  const bool slow = std::min(middle.s_u.norm(), middle.s_v.norm()) * kMostStretch < 1.0;
  if (!slow && normal.norm() > 1e-6 * middle.s_u.norm() * middle.s_v.norm()) {
    const Vec3 along = middle.s_u.normalized();
    axes.row(0) = normal.normalized();
    axes.row(1) = along;
    axes.row(2) = normal.normalized().cross(along);
    const Vec3 across = axes.row(2);
    if (middle.s_v.norm() > kHairThin * middle.s_u.norm()) {
      axes.row(1) = middle.s_v.normalized();
      axes.row(2) = normal.normalized().cross(middle.s_v.normalized());
    }
    bounds.stretch[0] = in_single(1.0 / middle.s_u.norm());
    bounds.stretch[1] = in_single(1.0 / across.dot(middle.s_v));
    bounds.stretch[2] = in_single(-bounds.stretch[0] * bounds.stretch[1] * along.dot(middle.s_v));
  }
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) bounds.axis[k][j] = axes(k, j);
  }
}

void set_middle(const SurfacePoint& middle, LeafBounds& bounds) {
  set_frame(middle, bounds);
  const Derivatives<Vec3> derivatives =
      stretched<Vec3>(bounds.stretch, AcrossS(middle), {middle.s_u, middle.s_v, middle.s_uu, middle.s_uv, middle.s_vv});
  for (int k = 0; k < 3; ++k) {
    bounds.middle[k] = in_single(middle.s[k]);
    bounds.low[k] = kNothing.low;
    bounds.high[k] = kNothing.high;
    for (std::size_t d = 0; d < kDerivatives; ++d) {
      bounds.derivative[d][k] = Vec3(bounds.axis[k]).dot(derivatives[d]);
      bounds.spread[d][k] = 0.0;
    }
  }
  for (std::size_t d = 0; d < kDerivatives; ++d) {
    bounds.self_low[d] = kNothing.low;
    bounds.self_high[d] = kNothing.high;
  }
}

/// The shortest turn that takes the x axis along a direction.
Eigen::Matrix3d turn_of_x(const Vec3& direction) {
  const Vec3 to = direction.normalized();
  if (to[0] < -1.0 + 1e-12) return Eigen::Vector3d(-1.0, -1.0, 1.0).asDiagonal();
  const double size = std::sqrt((1.0 + to[0]) * 2.0), over = 1.0 / size;
  return Eigen::Quaterniond(0.5 * size, 0.0, -to[2] * over, to[1] * over).toRotationMatrix();
}

/// A first derivative as a multiple of which it is that in the middle along the latter: where one is at right angles
/// to something, so is the other, and how fast the parameters run is out of it. As it was where that is not so.
IntervalVector turned(const IntervalVector& derivative, const Vec3& middle) {
  const Eigen::Matrix3d frame = turn_of_x(middle);
  const auto along = [&](Eigen::Index axis) {
    Interval sum;
    for (std::size_t k = 0; k < 3; ++k) sum = sum + frame(static_cast<Eigen::Index>(k), axis) * derivative[k];
    return sum;
  };
  const Interval speed = along(0);
  if (!(speed.low > 0.0)) return derivative;
  const double length = middle.norm();
  const Interval over = length * inverse(speed), first = over * along(1), second = over * along(2);
  IntervalVector out;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    out[k] = frame(axis, 1) * first + frame(axis, 2) * second + middle[axis];
  }
  return out;
}

/// The derivatives of 1/2 |S - c|^2 over a piece, whose derivatives of S are `range`. (S - c) . D is that with D as in
/// the middle, which the control points bound well, and the little that D differs.
Derivatives<Interval> self_range(const FramedPiece& piece, const LeafBounds& bounds, const IntervalVector& arm,
                                 const Derivatives<IntervalVector>& range) {
  Derivatives<Interval> self;
  for (std::size_t d = 0; d < kDerivatives; ++d) {
    const Vec3 middle(bounds.derivative[d]);
    IntervalVector beyond = range[d];
    for (std::size_t k = 0; k < 3; ++k) beyond[k] = beyond[k] + -middle[static_cast<Eigen::Index>(k)];
    self[d] = piece.extent(middle) + middle.dot(piece.origin()) + dot(arm, beyond);
  }
  return self;
}

void include_piece(const FramedPiece& piece, const AcrossS& across, LeafBounds& bounds) {
  PieceRange range = piece.range();
  for (std::size_t k = 0; k < 3; ++k) {
    range.place[k] = range.place[k] + piece.origin()[static_cast<Eigen::Index>(k)];
    bounds.low[k] = std::min(bounds.low[k], range.place[k].low);
    bounds.high[k] = std::max(bounds.high[k], range.place[k].high);
  }
  Derivatives<IntervalVector> derivatives = stretched(bounds.stretch, across, range.derivative);
  const Interval aa = square_sum(bounds.stretch[0] * derivatives[0]), bb = square_sum(derivatives[6]),
                 ab = dot(bounds.stretch[0] * derivatives[0], derivatives[6]);
  for (const std::size_t d : {0, 1, 5, 6}) derivatives[d] = turned(derivatives[d], Vec3(bounds.derivative[d]));
  Derivatives<Interval> self = self_range(piece, bounds, range.place, derivatives);
  self[2] = self[2] + aa;
  self[3] = self[3] + ab;
  self[4] = self[4] + bb;
  for (std::size_t d = 0; d < kDerivatives; ++d) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double farthest = (derivatives[d][k] + -bounds.derivative[d][k]).magnitude();
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
  LeafBounds bounds;
  const SurfacePoint middle = scaled(projected(h), rect.s_max - rect.s_min, rect.t_max - rect.t_min);
  set_middle(middle, bounds);
  const PieceFrame frame{Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&bounds.axis[0][0]),
                         Vec3(bounds.middle)};
  const BezierNet whole = net_of(span);
  const auto piece = [&](int i, int j) {
    const double d = 1.0 / kPieces;
    return FramedPiece(whole, {at_s(i * d), at_s((i + 1) * d), at_t(j * d), at_t((j + 1) * d)}, frame,
                       {kPieces, kPieces});
  };
  for (int k = 0; k < kPieces * kPieces; ++k) include_piece(piece(k / kPieces, k % kPieces), AcrossS(middle), bounds);
  double size = Vec3(bounds.middle).norm();
  for (int k = 0; k < 3; ++k) size += bounds.high[k] - bounds.low[k];
  widen(bounds.low, bounds.high, kWidening * size);
  for (std::size_t d = 0; d < kDerivatives; ++d) {
    const double derivative = Vec3(bounds.derivative[d]).norm();
    for (double& spread : bounds.spread[d]) spread += kWidening * (derivative + spread);
    const double by = kWidening * (size * derivative + std::abs(bounds.self_low[d]) + std::abs(bounds.self_high[d]));
    bounds.self_low[d] -= by;
    bounds.self_high[d] += by;
  }
  return packed(bounds);
}

}  // namespace bladefit
