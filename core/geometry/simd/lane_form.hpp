#pragma once
#include "core/geometry/simd/lane_vector.hpp"

namespace bladefit {
namespace {

/// Homogeneous point and derivatives of a Taylor form, as taylor::sum<3, 3> adds them up.
struct Form {
  Four a, a_u, a_v, a_uu, a_uv, a_vv;
};

BLADEFIT_INLINE Four coefficient(const double* form, int i, int j) {
  return *reinterpret_cast<const Unaligned*>(form + 4 * (4 * i + j));
}

/// One row with its first and half its second derivative along y.
BLADEFIT_INLINE void row(const double* form, int i, double y, Four& value, Four& first, Four& half_second) {
  first = coefficient(form, i, 3);
  value = first * y + coefficient(form, i, 2);
  half_second = first;
  first = first * y + value;
  value = value * y + coefficient(form, i, 1);
  half_second = half_second * y + first;
  first = first * y + value;
  value = value * y + coefficient(form, i, 0);
}

/// One step of Horner's rule along x: takes in the next lower row.
BLADEFIT_INLINE void take_row(const double* form, int i, double x, double y, Form& f) {
  Four value, first, half_second;
  row(form, i, y, value, first, half_second);
  f.a = f.a * x + value;
  f.a_v = f.a_v * x + first;
  f.a_vv = f.a_vv * x + half_second;
}

BLADEFIT_INLINE Form evaluate(const double* form, double x, double y) {
  Form f;
  row(form, 3, y, f.a, f.a_v, f.a_vv);
  f.a_u = f.a;
  f.a_uv = f.a_v;
  take_row(form, 2, x, y, f);
  f.a_uu = f.a_u;
  for (int i = 1; i >= 0; --i) {
    if (i == 0) f.a_uu = f.a_uu * x + f.a_u;
    f.a_u = f.a_u * x + f.a;
    f.a_uv = f.a_uv * x + f.a_v;
    take_row(form, i, x, y, f);
  }
  f.a_uu += f.a_uu;
  f.a_vv += f.a_vv;
  return f;
}

/// Four points, one a lane before, one a coordinate after; `w`: their fourth.
BLADEFIT_INLINE Four3 transposed(const Four& p, const Four& q, const Four& r, const Four& s, Four& w) {
  const Four pq_low = __builtin_shufflevector(p, q, 0, 4, 2, 6), pq_high = __builtin_shufflevector(p, q, 1, 5, 3, 7);
  const Four rs_low = __builtin_shufflevector(r, s, 0, 4, 2, 6), rs_high = __builtin_shufflevector(r, s, 1, 5, 3, 7);
  w = __builtin_shufflevector(pq_high, rs_high, 2, 3, 6, 7);
  return {__builtin_shufflevector(pq_low, rs_low, 0, 1, 4, 5), __builtin_shufflevector(pq_high, rs_high, 0, 1, 4, 5),
          __builtin_shufflevector(pq_low, rs_low, 2, 3, 6, 7)};
}

}  // namespace
}  // namespace bladefit
