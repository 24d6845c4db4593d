#pragma once
#include <cstdint>

#include "core/geometry/surface/bezier.hpp"

namespace bladefit {

/// A span's Taylor form about its middle: its point is the sum of c_ij x^i y^j with x = s - 1/2, y = t - 1/2, c_ij
/// homogeneous, row by row in i as a control net. Half the work of Bernstein polynomials, and as exact: |x|, |y| <=
/// 1/2.

/// Value and derivatives up to the second order of a homogeneous patch in its local parameters.
struct HomogeneousDerivatives {
  Homogeneous a, a_u, a_v, a_uu, a_uv, a_vv;
};

/// Turns a net, 4 (degree_u + 1)(degree_v + 1) doubles, into its Taylor form. Cost: cubic in the degrees.
void to_taylor_form(std::uint32_t degree_u, std::uint32_t degree_v, double* net);

namespace taylor {

/// One row with its first and half its second derivative along y, by Horner's rule.
template <std::uint32_t Degree>
[[gnu::always_inline]] inline void sum_row(const double* row, std::uint32_t degree, double y, Homogeneous& value,
                                           Homogeneous& first, Homogeneous& half_second) {
  using Coefficient = Eigen::Map<const Homogeneous>;
  const std::uint32_t n = Degree != 0 ? Degree : degree;
  value = first = Coefficient(row + 4 * n);
  value = value * y + Coefficient(row + 4 * (n - 1));
  if (n == 1) {
    half_second = Homogeneous::Zero();
    return;
  }
  half_second = first;
  first = first * y + value;
  value = value * y + Coefficient(row + 4 * (n - 2));
  for (std::uint32_t i = n - 2; i-- > 0;) {
    half_second = half_second * y + first;
    first = first * y + value;
    value = value * y + Coefficient(row + 4 * i);
  }
}

/// One step of Horner's rule along x: takes in the next lower row.
template <std::uint32_t Degree>
[[gnu::always_inline]] inline void take_row(const double* row, std::uint32_t degree, double x, double y,
                                            HomogeneousDerivatives& out) {
  Homogeneous value, first, half_second;
  sum_row<Degree>(row, degree, y, value, first, half_second);
  out.a = out.a * x + value;
  out.a_v = out.a_v * x + first;
  out.a_vv = out.a_vv * x + half_second;
}

/// With compile-time degrees (3, 3 in wide registers, to the same bits: core/lanes/lane_form.hpp), so that the loops
/// unroll; 0: those given.
template <std::uint32_t DegreeU, std::uint32_t DegreeV>
[[gnu::always_inline]] inline void sum(const double* c, std::uint32_t degree_u, std::uint32_t degree_v, double x,
                                       double y, HomogeneousDerivatives& out) {
  const std::uint32_t p = DegreeU != 0 ? DegreeU : degree_u, stride = 4 * ((DegreeV != 0 ? DegreeV : degree_v) + 1);
  sum_row<DegreeV>(c + p * stride, degree_v, y, out.a, out.a_v, out.a_vv);
  out.a_u = out.a;
  out.a_uv = out.a_v;
  take_row<DegreeV>(c + (p - 1) * stride, degree_v, x, y, out);
  out.a_uu = p == 1 ? Homogeneous(Homogeneous::Zero()) : out.a_u;
  for (std::uint32_t i = p - 1; i-- > 0;) {
    if (i + 2 < p) out.a_uu = out.a_uu * x + out.a_u;
    out.a_u = out.a_u * x + out.a;
    out.a_uv = out.a_uv * x + out.a_v;
    take_row<DegreeV>(c + i * stride, degree_v, x, y, out);
  }
  out.a_uu += out.a_uu;
  out.a_vv += out.a_vv;
}

/// Any degrees.
void sum_any(const double* c, std::uint32_t degree_u, std::uint32_t degree_v, double x, double y,
             HomogeneousDerivatives& out);

}  // namespace taylor

/// Evaluates a Taylor form at (x, y). In line, since it is most of the work of every fit.
/// Cost: 38 four-vector multiplications and as many additions for a bicubic form, which is the fast path.
[[gnu::always_inline]] inline void evaluate_taylor(const double* form, std::uint32_t degree_u, std::uint32_t degree_v,
                                                   double x, double y, HomogeneousDerivatives& out) {
  if (degree_u == 3 && degree_v == 3) {
    taylor::sum<3, 3>(form, 3, 3, x, y, out);
  } else {
    taylor::sum_any(form, degree_u, degree_v, x, y, out);
  }
}

/// Makes A / w and its derivatives of h, by the quotient rule; the fourth components then mean nothing.
[[gnu::always_inline]] inline void project(HomogeneousDerivatives& h) {
  const double inverse = 1.0 / h.a[3], w_u = h.a_u[3], w_v = h.a_v[3];
  h.a *= inverse;
  h.a_u = (h.a_u - w_u * h.a) * inverse;
  h.a_v = (h.a_v - w_v * h.a) * inverse;
  h.a_uu = (h.a_uu - (2.0 * w_u) * h.a_u - h.a_uu[3] * h.a) * inverse;
  h.a_uv = (h.a_uv - w_u * h.a_v - w_v * h.a_u - h.a_uv[3] * h.a) * inverse;
  h.a_vv = (h.a_vv - (2.0 * w_v) * h.a_v - h.a_vv[3] * h.a) * inverse;
}

}  // namespace bladefit
