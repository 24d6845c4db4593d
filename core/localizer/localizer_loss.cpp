#include <algorithm>
#include <cmath>

#include "core/localizer.hpp"

namespace bladefit {
namespace {

/// Standard deviation of normal errors over the median of their size.
constexpr double kMedianToScale = 1.4826;
/// Halvings of the interval that holds the median: to a billionth of the largest distance.
constexpr int kHalvings = 30;
/// A scale that changes by less than this share is at rest; before the last stage, by less than the second.
constexpr double kAtRest = 1e-6, kNearRest = 1e-2;
/// Rounds of scale and fit.
constexpr std::uint32_t kMaxRounds = 30;

}  // namespace

/// Back to the loss that holds before anything is known of the distances.
void Localizer::begin_loss() {
  loss_ = config_.loss_scale_mm > 0.0 ? config_.loss : Loss::none;
  loss_scale_ = config_.loss_scale_mm;
}

/// 1.4826 times the median distance of the points that count, not below the noise floor [mm]. Cost: some thirty passes.
double Localizer::robust_scale() const {
  std::uint32_t counted = 0;
  double high = 0.0;
  const auto each = [this](auto use) {
    for (std::uint32_t i = 0; i < stored_; ++i) {
      if (!left_out(points_[i], points_[i].foot)) use(std::abs(points_[i].foot.distance));
    }
  };
  each([&](double d) {
    ++counted;
    high = std::max(high, d);
  });
  double low = 0.0;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    std::uint32_t below = 0;
    each([&](double d) { below += d <= middle ? 1U : 0U; });
    (2 * below >= counted ? high : low) = middle;
  }
  return std::max(config_.noise_floor_mm, kMedianToScale * high);
}

/// After the fit with one scale has converged: takes the scale of its distances. Tukey's loss has several minima, so
/// Huber's, which has one, leads to the right one. False: the scale is at rest.
bool Localizer::adapt_loss() {
  if (config_.loss == Loss::none || config_.loss_scale_mm > 0.0) return false;
  Refinement& r = refinement_;
  if (r.rounds++ == kMaxRounds) return false;
  const double scale = robust_scale();
  const double change = loss_ == Loss::none ? 1.0 : std::abs(scale / loss_scale_ - 1.0);
  if (loss_ == config_.loss && change <= kAtRest) return false;
  if (loss_ == Loss::none) {
    loss_ = Loss::huber;
  } else if (change <= kNearRest) {
    loss_ = config_.loss;
  }
  loss_scale_ = scale;
  r.last_step.setConstant(frame_.length);  // the sums are of the old loss: a sweep must come before the next step
  r.sweeps = 0;
  return true;
}

}  // namespace bladefit
