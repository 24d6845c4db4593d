#include "core/programs/bound_rows.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

double relative_change(double from, double to) { return from == to ? 0.0 : std::abs(from - to) / std::max(from, to); }

}  // namespace

void BoundRows::attach(double* memory, std::uint32_t capacity) {
  memory_ = memory;
  capacity_ = capacity;
}

void BoundRows::begin(std::uint32_t count, bool within) {
  count_ = count;
  within_ = within;
  limits_ = 0;
}

double BoundRows::set_weight(std::uint32_t i, const Limits& weight) {
  const Limits kept = this->weight(i);
  column(kWeight)[i] = weight.plus();
  column(kLowerWeight)[i] = weight.minus();
  lopsided_ = lopsided_ || weight.plus() != weight.minus();
  return std::max(relative_change(kept.plus(), weight.plus()), relative_change(kept.minus(), weight.minus()));
}

void BoundRows::set(std::uint32_t i, const Vec6& gradient, double distance) {
  const Limits bounds = within_ ? weight(i) : Limits::both(0.0);
  for (int k = 0; k < 6; ++k) column(k)[i] = gradient[k];
  column(kLower)[i] = -bounds.minus() - distance;
  column(kUpper)[i] = bounds.plus() - distance;
}

void BoundRows::skip(std::uint32_t i) {
  for (int k = 0; k < 6; ++k) column(k)[i] = 0.0;
  column(kLower)[i] = -kUnbounded;
  column(kUpper)[i] = kUnbounded;
}

void BoundRows::set_bounds(std::uint32_t i, const Bounds& bounds) {
  column(kLower)[i] = bounds.lower;
  column(kUpper)[i] = bounds.upper;
}

double BoundRows::distance(std::uint32_t i) const {
  const double middle = within_ ? 0.5 * (column(kWeight)[i] - column(kLowerWeight)[i]) : 0.0;
  return middle - 0.5 * (column(kLower)[i] + column(kUpper)[i]);
}

BoundRows::Extremes BoundRows::extremes() const {
  Extremes out{kUnbounded, -kUnbounded};
  for (std::uint32_t i = 0; i < count_; ++i) {
    const double d = distance(i);
    if (std::isnan(d)) continue;
    out.least = std::min(out.least, d);
    out.most = std::max(out.most, d);
  }
  return out;
}

double BoundRows::largest(bool weighted) const {
  double ratio = 0.0;
  for (std::uint32_t i = 0; i < count_; ++i) {
    const double d = distance(i);
    if (!std::isnan(d)) ratio = std::max(ratio, std::abs(d) / (weighted ? weight(i).of(d) : 1.0));
  }
  return ratio;
}

double BoundRows::violation() const {
  double violation = broken_limit();
  for (std::uint32_t i = 0; i < count_; ++i) violation = std::max({violation, column(kLower)[i], -column(kUpper)[i]});
  return violation;
}

void BoundRows::set_limit(std::uint32_t k, double value, const Vec6& gradient) {
  const std::uint32_t row = count_ + k;
  for (int j = 0; j < 6; ++j) column(j)[row] = gradient[j];
  column(kLower)[row] = -kUnbounded;
  column(kUpper)[row] = -value;
}

double BoundRows::broken_limit() const {
  double broken = 0.0;
  for (std::uint32_t k = 0; k < limits_; ++k) broken = std::max(broken, -column(kUpper)[count_ + k]);
  return broken;
}

ConstraintRows BoundRows::view() const {
  ConstraintRows rows;
  rows.coefficients = memory_;
  rows.stride = static_cast<std::ptrdiff_t>(stride());
  rows.count = static_cast<int>(count_ + limits_);
  rows.width = 6;
  rows.lower = column(kLower);
  rows.upper = column(kUpper);
  rows.plain = static_cast<int>(limits_);
  return rows;
}

void BoundRows::add_weights(ConstraintRows& rows) const {
  rows.weight = column(kWeight);
  if (lopsided_) rows.lower_weight = column(kLowerWeight);
}

}  // namespace bladefit
