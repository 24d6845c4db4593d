#pragma once
#include <cstdint>

#include "core/geometry/surface/bezier.hpp"

namespace bladefit {

/// Where a span's Bezier control points come from: see ImagePatch and ImageSpan. Views.
struct SpanSource {
  const double* points;    ///< the first control point that it takes part in
  std::uint32_t points_v;  ///< control points from one row to the next
  const double* along_u;   ///< its extractions, (degree + 1) x (degree + 1) numbers each
  const double* along_v;
  std::uint32_t degree_u, degree_v;
  bool rational;  ///< false: every weight is 1
};

/// Writes the control points of the Bezier form, 4 (degree_u + 1)(degree_v + 1) numbers, row by row in u. Sums are in
/// one order, so that they are the same wherever they are taken. Cost: (degree_u + 1)(degree_v + 1)(degree_u + degree_v
/// + 2) points weighed.
void bezier_points(const SpanSource& source, double* net);

/// Row `number` of them, in u, or column, in v, to the same bits. Cost: less, and little of the stack.
using BezierRow = std::array<Homogeneous, kMaxOrder>;
void bezier_row(const SpanSource& source, std::uint32_t number, BezierRow& row);
void bezier_column(const SpanSource& source, std::uint32_t number, BezierRow& column);

/// Those of a span of an image whose indices hold.
[[nodiscard]] SpanSource source_of(const DesignImage& image, const ImageSpan& span);
void bezier_net(const DesignImage& image, const ImageSpan& span, BezierNet& out);

}  // namespace bladefit
