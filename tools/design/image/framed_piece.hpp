#pragma once
#include <limits>

#include "core/geometry/surface/bezier.hpp"
#include "core/geometry/surface/foot.hpp"
#include "tools/design/image/interval.hpp"
#include "tools/design/nurbs/bezier_extraction.hpp"

namespace bladefit {

inline constexpr Interval kNothing{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

/// Where a piece is looked at from: orthonormal axes, one a row, about a middle [mm].
struct PieceFrame {
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> axes;
  Vec3 middle;
};

/// What derivatives along the piece's own parameters, 0..1, are multiplied by to be those wanted.
struct PieceScale {
  double along_u, along_v;
};

/// S - origin and its derivatives s, t, ss, st, tt over a piece.
struct PieceRange {
  IntervalVector place;
  std::array<IntervalVector, 5> derivative;
};

/// A rectangle of a span: its net in a frame, moved to an origin of its own.
class FramedPiece {
 public:
  /// `whole`: the net of the span.
  FramedPiece(BezierNet whole, const LocalRect& rect, const PieceFrame& frame, PieceScale scale);

  /// By the control points of the homogeneous derivatives, and the quotient rule on A / w with intervals; small because
  /// A is taken about the piece's own origin. Cost: some microseconds for a bicubic span.
  [[nodiscard]] PieceRange range() const;

  /// (S - origin) . direction: between those of the control points.
  [[nodiscard]] Interval extent(const Vec3& direction) const;

  /// From the middle of the frame, in its axes.
  [[nodiscard]] const Vec3& origin() const { return origin_; }

 private:
  /// Ranges of a homogeneous quantity.
  struct HomogeneousRange {
    IntervalVector place;
    Interval weight;
  };
  [[nodiscard]] HomogeneousRange derivative(std::uint32_t along_u, std::uint32_t along_v) const;

  BezierNet net_;
  Vec3 origin_;
  PieceScale scale_;
};

}  // namespace bladefit
