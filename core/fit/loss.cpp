#include "core/fit/loss.hpp"

#include <cmath>

namespace bladefit {
namespace {

constexpr double kHuber = 1.345, kTukey = 4.685;

LossTerms huber(double d, double limit) {
  const double size = std::abs(d);
  if (size <= limit) return {0.5 * d * d, d, 1.0, 1.0};
  return {limit * (size - 0.5 * limit), std::copysign(limit, d), 0.0, limit / size};
}

LossTerms tukey(double d, double limit) {
  if (std::abs(d) >= limit) return {limit * limit / 6.0, 0.0, 0.0, 0.0};
  const double t = d / limit, rest = 1.0 - t * t;
  return {limit * limit / 6.0 * (1.0 - rest * rest * rest), d * rest * rest, rest * (1.0 - 5.0 * t * t), rest * rest};
}

}  // namespace

LossTerms loss_terms(Loss loss, double scale, double d) {
  if (loss == Loss::none) return {0.5 * d * d, d, 1.0, 1.0};
  return loss == Loss::huber ? huber(d, kHuber * scale) : tukey(d, kTukey * scale);
}

}  // namespace bladefit
