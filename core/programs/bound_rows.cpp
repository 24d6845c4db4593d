#include "core/programs/bound_rows.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {

void BoundRows::attach(double* memory, std::uint32_t capacity) {
  memory_ = memory;
  capacity_ = capacity;
}

void BoundRows::begin(std::uint32_t count) {
  count_ = count;
  limits_ = 0;
}

double BoundRows::set_weight(std::uint32_t i, double weight) {
  double& kept = column(kWeight)[i];
  const double change = kept == weight ? 0.0 : std::abs(kept - weight) / std::max(kept, weight);
  kept = weight;
  return change;
}

void BoundRows::set(std::uint32_t i, const Vec6& gradient, double distance, double half) {
  for (int k = 0; k < 6; ++k) column(k)[i] = gradient[k];
  column(kLower)[i] = -half - distance;
  column(kUpper)[i] = half - distance;
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

double BoundRows::distance(std::uint32_t i) const { return -0.5 * (column(kLower)[i] + column(kUpper)[i]); }

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
    if (!std::isnan(d)) ratio = std::max(ratio, std::abs(d) / (weighted ? weight(i) : 1.0));
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

}  // namespace bladefit
