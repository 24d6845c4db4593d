#include "tools/design/image/framed_piece.hpp"

#include <utility>

namespace bladefit {

FramedPiece::FramedPiece(BezierNet whole, const LocalRect& rect, const PieceFrame& frame, PieceScale scale)
    : net_(std::move(whole)), scale_(scale) {
  restrict_net(rect, net_);
  // As a map, which Eigen sums up in the same order everywhere: images are the same to the last bit.
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> axes(frame.axes.data());
  const Homogeneous& corner = net_.at(net_.degree_u / 2, net_.degree_v / 2);
  const Vec3 origin = corner.head<3>() / corner[3];
  for (std::uint32_t k = 0; k < (net_.degree_u + 1) * (net_.degree_v + 1); ++k) {
    const Vec3 arm = Vec3(net_.points[k].head<3>()) - net_.points[k][3] * origin;
    net_.points[k].head<3>() = axes * arm;
  }
  origin_ = axes * (origin - frame.middle);
}

/// Control values of the derivative of order (along_u, along_v): differences, times the factor of the degrees.
FramedPiece::HomogeneousRange FramedPiece::derivative(std::uint32_t along_u, std::uint32_t along_v) const {
  if (along_u > net_.degree_u || along_v > net_.degree_v) return HomogeneousRange{};
  BezierNet d = net_;
  double factor = 1.0;
  for (std::uint32_t k = 0; k < along_u; ++k) {
    factor *= (net_.degree_u - k) * scale_.along_u;
    for (std::uint32_t i = 0; i < net_.degree_u - k; ++i) {
      for (std::uint32_t j = 0; j <= net_.degree_v; ++j) d.at(i, j) = d.at(i + 1, j) - Homogeneous(d.at(i, j));
    }
  }
  for (std::uint32_t k = 0; k < along_v; ++k) {
    factor *= (net_.degree_v - k) * scale_.along_v;
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

Interval FramedPiece::extent(const Vec3& direction) const {
  Interval range = kNothing;
  for (std::uint32_t k = 0; k < (net_.degree_u + 1) * (net_.degree_v + 1); ++k) {
    const double along = direction.dot(Vec3(net_.points[k].head<3>())) / net_.points[k][3];
    range.include({along, along});
  }
  return range;
}

PieceRange FramedPiece::range() const {
  const HomogeneousRange value = derivative(0, 0), s = derivative(1, 0), t = derivative(0, 1), ss = derivative(2, 0),
                         st = derivative(1, 1), tt = derivative(0, 2);
  const Interval over = inverse(value.weight);
  PieceRange out;
  out.place = {extent(Vec3::UnitX()), extent(Vec3::UnitY()), extent(Vec3::UnitZ())};
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

}  // namespace bladefit
