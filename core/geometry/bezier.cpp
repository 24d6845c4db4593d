#include "core/geometry/bezier.hpp"

namespace bladefit {
namespace {

using NetPoint = Eigen::Map<const Homogeneous>;

/// Bernstein polynomials of one degree with their first and second derivatives.
struct Basis {
  std::array<double, kMaxOrder> b, d, dd;
};

void cubic_basis(double t, Basis& basis) {
  const double r = 1.0 - t;
  basis.b[0] = r * r * r;
  basis.b[1] = 3.0 * t * r * r;
  basis.b[2] = 3.0 * t * t * r;
  basis.b[3] = t * t * t;
  basis.d[0] = -3.0 * r * r;
  basis.d[1] = 3.0 * r * (r - 2.0 * t);
  basis.d[2] = 3.0 * t * (2.0 * r - t);
  basis.d[3] = 3.0 * t * t;
  basis.dd[0] = 6.0 * r;
  basis.dd[1] = 6.0 * (t - 2.0 * r);
  basis.dd[2] = 6.0 * (r - 2.0 * t);
  basis.dd[3] = 6.0 * t;
}

/// b of degree n from b of degree n - 1, in place: b_i^n = (1 - t) b_i^(n-1) + t b_(i-1)^(n-1).
void raise_degree(std::array<double, kMaxOrder>& b, std::uint32_t n, double t) {
  b[n] = t * b[n - 1];
  for (std::uint32_t i = n - 1; i > 0; --i) b[i] = (1.0 - t) * b[i] + t * b[i - 1];
  b[0] = (1.0 - t) * b[0];
}

/// Derivative of b_i^n is n (b_(i-1)^(n-1) - b_i^(n-1)).
void differentiate(const std::array<double, kMaxOrder>& lower, std::uint32_t n, std::array<double, kMaxOrder>& out) {
  const auto factor = static_cast<double>(n);
  out[0] = -factor * lower[0];
  for (std::uint32_t i = 1; i < n; ++i) out[i] = factor * (lower[i - 1] - lower[i]);
  out[n] = factor * lower[n - 1];
}

void general_basis(std::uint32_t degree, double t, Basis& basis) {
  std::array<double, kMaxOrder> b{1.0}, first{};
  basis.dd.fill(0.0);
  for (std::uint32_t n = 1; n <= degree; ++n) {
    if (n == degree) {
      differentiate(b, n, basis.d);
      // The second derivative is the derivative of the first, which has degree n - 1: twice the lower basis.
      if (n >= 2) {
        const auto factor = static_cast<double>(n);
        for (std::uint32_t i = 0; i <= n; ++i)
          basis.dd[i] = factor * ((i > 0 ? first[i - 1] : 0.0) - (i < n ? first[i] : 0.0));
      }
    } else {
      differentiate(b, n, first);
    }
    raise_degree(b, n, t);
  }
  basis.b = b;
}

/// Sums over the net with compile-time orders, so that the loops unroll and vectorise.
template <std::uint32_t OrderU, std::uint32_t OrderV>
void sum_net(const double* net, const Basis& bu, const Basis& bv, std::uint32_t order_u, std::uint32_t order_v,
             HomogeneousDerivatives& out) {
  const std::uint32_t nu = OrderU != 0 ? OrderU : order_u;
  const std::uint32_t nv = OrderV != 0 ? OrderV : order_v;
  Homogeneous a = Homogeneous::Zero(), a_u = a, a_v = a, a_uu = a, a_uv = a, a_vv = a;
  for (std::uint32_t i = 0; i < nu; ++i) {
    Homogeneous row = Homogeneous::Zero(), row_v = row, row_vv = row;
    for (std::uint32_t j = 0; j < nv; ++j) {
      const NetPoint p(net + 4U * (i * nv + j));
      row += bv.b[j] * p;
      row_v += bv.d[j] * p;
      row_vv += bv.dd[j] * p;
    }
    a += bu.b[i] * row;
    a_u += bu.d[i] * row;
    a_uu += bu.dd[i] * row;
    a_v += bu.b[i] * row_v;
    a_uv += bu.d[i] * row_v;
    a_vv += bu.b[i] * row_vv;
  }
  out = {a, a_u, a_v, a_uu, a_uv, a_vv};
}

/// Restricts one control polygon of n + 1 points, `stride` apart, to [t0, t1].
void restrict_polygon(Homogeneous* points, std::uint32_t n, std::uint32_t stride, double t0, double t1) {
  if (t0 >= 1.0) {
    for (std::uint32_t i = 0; i < n; ++i) points[i * stride] = points[n * stride];
    return;
  }
  // Right part of the cut at t0, then left part of the cut at the image of t1.
  for (std::uint32_t k = n; t0 > 0.0 && k > 0; --k) {
    for (std::uint32_t i = 0; i < k; ++i)
      points[i * stride] = (1.0 - t0) * points[i * stride] + t0 * points[(i + 1) * stride];
  }
  const double t = (t1 - t0) / (1.0 - t0);
  for (std::uint32_t k = 1; t < 1.0 && k <= n; ++k) {
    for (std::uint32_t i = n; i >= k; --i)
      points[i * stride] = (1.0 - t) * points[(i - 1) * stride] + t * points[i * stride];
  }
}

}  // namespace

void evaluate_bezier(const double* net, std::uint32_t degree_u, std::uint32_t degree_v, double s, double t,
                     HomogeneousDerivatives& out) {
  Basis bu, bv;
  if (degree_u == 3 && degree_v == 3) {
    cubic_basis(s, bu);
    cubic_basis(t, bv);
    sum_net<4, 4>(net, bu, bv, 4, 4, out);
    return;
  }
  general_basis(degree_u, s, bu);
  general_basis(degree_v, t, bv);
  sum_net<0, 0>(net, bu, bv, degree_u + 1, degree_v + 1, out);
}

void restrict_net(const double* net, std::uint32_t degree_u, std::uint32_t degree_v, const LocalRect& rect,
                  BezierNet& out) {
  out.degree_u = degree_u;
  out.degree_v = degree_v;
  const std::uint32_t columns = degree_v + 1, count = (degree_u + 1) * columns;
  for (std::uint32_t k = 0; k < count; ++k) out.points[k] = NetPoint(net + 4U * k);
  for (std::uint32_t j = 0; j < columns; ++j)
    restrict_polygon(&out.points[j], degree_u, columns, rect.s_min, rect.s_max);
  for (std::uint32_t i = 0; i <= degree_u; ++i)
    restrict_polygon(&out.points[i * columns], degree_v, 1, rect.t_min, rect.t_max);
}

}  // namespace bladefit
