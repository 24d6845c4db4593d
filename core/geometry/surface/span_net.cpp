#include "core/geometry/surface/span_net.hpp"

namespace bladefit {
namespace {

using Point = Eigen::Map<Homogeneous>;
using GivenPoint = Eigen::Map<const Homogeneous>;

}  // namespace

void bezier_points(const SpanSource& source, double* net) {
  const std::uint32_t rows = source.degree_u + 1, columns = source.degree_v + 1;
  for (std::uint32_t i = 0; i < rows; ++i) {
    const double* share = source.along_u + i * rows;
    for (std::uint32_t j = 0; j < columns; ++j) {
      Homogeneous sum = share[0] * GivenPoint(source.points + 4U * j);
      for (std::uint32_t k = 1; k < rows; ++k) {
        sum += share[k] * GivenPoint(source.points + 4U * (static_cast<std::size_t>(k) * source.points_v + j));
      }
      Point(net + 4U * (i * columns + j)) = sum;
    }
  }
  std::array<Homogeneous, kMaxOrder> row;
  for (std::uint32_t i = 0; i < rows; ++i) {
    double* const first = net + 4U * i * columns;
    for (std::uint32_t j = 0; j < columns; ++j) row[j] = GivenPoint(first + 4U * j);
    for (std::uint32_t j = 0; j < columns; ++j) {
      const double* share = source.along_v + j * columns;
      Homogeneous sum = share[0] * row[0];
      for (std::uint32_t k = 1; k < columns; ++k) sum += share[k] * row[k];
      if (!source.rational) sum[3] = 1.0;
      Point(first + 4U * j) = sum;
    }
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
