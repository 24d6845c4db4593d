#include "core/geometry/surface/span_net.hpp"

namespace bladefit {
namespace {

using GivenPoint = Eigen::Map<const Homogeneous>;

/// The control points along v of row i, as yet not those of spans in v.
void weigh_rows(const SpanSource& source, std::uint32_t i, BezierRow& row) {
  const std::uint32_t rows = source.degree_u + 1;
  const double* share = source.along_u + i * rows;
  for (std::uint32_t j = 0; j <= source.degree_v; ++j) {
    row[j] = share[0] * GivenPoint(source.points + 4U * j);
    for (std::uint32_t k = 1; k < rows; ++k)
      row[j] += share[k] * GivenPoint(source.points + 4U * (static_cast<std::size_t>(k) * source.points_v + j));
  }
}

/// Of a row that weigh_rows() has made, the Bezier control point j.
Homogeneous weighed(const SpanSource& source, const BezierRow& row, std::uint32_t j) {
  const std::uint32_t columns = source.degree_v + 1;
  const double* share = source.along_v + j * columns;
  Homogeneous sum = share[0] * row[0];
  for (std::uint32_t k = 1; k < columns; ++k) sum += share[k] * row[k];
  if (!source.rational) sum[3] = 1.0;
  return sum;
}

}  // namespace

void bezier_points(const SpanSource& source, double* net) {
  const std::uint32_t columns = source.degree_v + 1;
  BezierRow row;
  for (std::uint32_t i = 0; i <= source.degree_u; ++i) {
    weigh_rows(source, i, row);
    for (std::uint32_t j = 0; j < columns; ++j)
      Eigen::Map<Homogeneous>(net + 4U * (i * columns + j)) = weighed(source, row, j);
  }
}

void bezier_row(const SpanSource& source, std::uint32_t number, BezierRow& row) {
  BezierRow given;
  weigh_rows(source, number, given);
  for (std::uint32_t j = 0; j <= source.degree_v; ++j) row[j] = weighed(source, given, j);
}

void bezier_column(const SpanSource& source, std::uint32_t number, BezierRow& column) {
  BezierRow row;
  for (std::uint32_t i = 0; i <= source.degree_u; ++i) {
    weigh_rows(source, i, row);
    column[i] = weighed(source, row, number);
  }
}

SpanSource source_of(const DesignImage& image, const ImageSpan& span) {
  const ImagePatch& p = image.patches()[span.patch];
  const std::uint32_t rows = p.degree_u + 1, columns = p.degree_v + 1;
  const double* extractions = image.extractions().data();
  return {image.points().data() + 4U * static_cast<std::size_t>(span.first_point),
          p.points_v,
          extractions + p.first_extraction_u + static_cast<std::size_t>(span.iu) * rows * rows,
          extractions + p.first_extraction_v + static_cast<std::size_t>(span.iv) * columns * columns,
          p.degree_u,
          p.degree_v,
          p.rational != 0};
}

void bezier_net(const DesignImage& image, const ImageSpan& span, BezierNet& out) {
  const SpanSource source = source_of(image, span);
  out.degree_u = source.degree_u;
  out.degree_v = source.degree_v;
  bezier_points(source, out.points[0].data());
}

}  // namespace bladefit
