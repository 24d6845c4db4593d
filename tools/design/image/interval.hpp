#pragma once
#include <algorithm>
#include <array>
#include <cmath>

namespace bladefit {

/// A range of numbers. Rounding is not directed: whoever hands a result on widens it by far more than that.
struct Interval {
  double low = 0, high = 0;

  [[nodiscard]] double magnitude() const { return std::max(std::abs(low), std::abs(high)); }
  void include(const Interval& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
};

inline Interval operator+(const Interval& a, const Interval& b) { return {a.low + b.low, a.high + b.high}; }
inline Interval operator-(const Interval& a, const Interval& b) { return {a.low - b.high, a.high - b.low}; }
inline Interval operator*(const Interval& a, const Interval& b) {
  const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
  return {std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s))};
}
inline Interval operator*(double f, const Interval& a) {
  const double p = f * a.low, q = f * a.high;
  return {std::min(p, q), std::max(p, q)};
}
inline Interval operator+(const Interval& a, double shift) { return {a.low + shift, a.high + shift}; }
/// 1 / a; `a` must be positive.
inline Interval inverse(const Interval& a) { return {1.0 / a.high, 1.0 / a.low}; }
inline Interval square(const Interval& a) {
  const double most = a.magnitude();
  const double least = a.low <= 0.0 && a.high >= 0.0 ? 0.0 : std::min(std::abs(a.low), std::abs(a.high));
  return {least * least, most * most};
}

using IntervalVector = std::array<Interval, 3>;

inline IntervalVector operator-(const IntervalVector& a, const IntervalVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline IntervalVector operator+(const IntervalVector& a, const IntervalVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline IntervalVector operator*(const Interval& f, const IntervalVector& a) { return {f * a[0], f * a[1], f * a[2]}; }
inline IntervalVector operator*(double f, const IntervalVector& a) { return {f * a[0], f * a[1], f * a[2]}; }
inline Interval dot(const IntervalVector& a, const IntervalVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Interval square_sum(const IntervalVector& a) { return square(a[0]) + square(a[1]) + square(a[2]); }

}  // namespace bladefit
