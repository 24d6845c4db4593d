#include "tools/design/image/piece_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/geometry/surface/bezier.hpp"
#include "core/geometry/surface/surface.hpp"

namespace bladefit {
namespace {

using ControlPolygon = std::vector<Eigen::Vector4d>;

/// What rounding may do to a coefficient, as a share of the largest.
constexpr double kCoefficientRounding = 1e-14;

double choose(std::uint32_t n, std::uint32_t k) {
  double result = 1;
  for (std::uint32_t i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return result;
}

/// The curve along the diagonal of a net: its degree is the sum of both.
ControlPolygon diagonal_of(const BezierNet& net, bool u_falls, bool v_falls) {
  const std::uint32_t p = net.degree_u, q = net.degree_v;
  ControlPolygon polygon(p + q + 1, Eigen::Vector4d::Zero());
  for (std::uint32_t i = 0; i <= p; ++i) {
    for (std::uint32_t j = 0; j <= q; ++j) {
      const Homogeneous& point = net.at(u_falls ? p - i : i, v_falls ? q - j : j);
      polygon[i + j] += choose(p, i) * choose(q, j) / choose(p + q, i + j) * point.matrix();
    }
  }
  return polygon;
}

/// The longest of the control vectors of the derivative of this order: of the points, and of the weights.
struct LongestVectors {
  double point, weight;
};
LongestVectors longest(ControlPolygon polygon, std::size_t order, double rounding) {
  double factor = 1;
  for (std::size_t k = 0; k < order; ++k) {
    if (polygon.size() == 1) return {0, 0};
    factor *= 2 * static_cast<double>(polygon.size() - 1);
    for (std::size_t i = 0; i + 1 < polygon.size(); ++i) polygon[i] = polygon[i + 1] - polygon[i].eval();
    polygon.pop_back();
  }
  const double scale = factor / std::exp2(static_cast<double>(order));
  LongestVectors out{0, 0};
  for (const Eigen::Vector4d& c : polygon) {
    out.point = std::max(out.point, scale * c.head<3>().norm());
    out.weight = std::max(out.weight, scale * std::abs(c[3]));
  }
  return {out.point + factor * rounding, out.weight + (out.weight > 0 ? factor * kCoefficientRounding : 0.0)};
}

}  // namespace

PieceBounds piece_bounds(const BezierSpan& span, const SpanLine& line) {
  const LocalRect rect{std::min(line.s_from, line.s_to), std::max(line.s_from, line.s_to),
                       std::min(line.t_from, line.t_to), std::max(line.t_from, line.t_to)};
  BezierNet net = net_of(span);
  restrict_net(rect, net);
  ControlPolygon polygon = diagonal_of(net, line.s_from > line.s_to, line.t_from > line.t_to);
  PieceBounds out;
  HomogeneousDerivatives h;
  evaluate_taylor(span.taylor, span.degree_u, span.degree_v, line.s_from - 0.5, line.t_from - 0.5, h);
  out.start = projected(h).s;
  out.end = polygon.back().head<3>() / polygon.back()[3];
  // About the start, since the quotient rule is of points that are near to the origin.
  double size = 0, reach = 0, least = polygon[0][3];
  for (Eigen::Vector4d& c : polygon) {
    size = std::max(size, c.head<3>().norm());
    c.head<3>() -= c[3] * out.start;
    reach = std::max(reach, c.head<3>().norm() / c[3]);
    least = std::min(least, c[3]);
  }
  const double rounding = kCoefficientRounding * size;
  const LongestVectors a = longest(polygon, 1, rounding), b = longest(polygon, 2, rounding),
                       c = longest(polygon, 3, rounding);
  out.slope = (a.point + a.weight * reach) / least;
  out.bend = (b.point + 2 * a.weight * out.slope + b.weight * reach) / least;
  out.third = (c.point + 3 * a.weight * out.bend + 3 * b.weight * out.slope + c.weight * reach) / least;
  return out;
}

}  // namespace bladefit
