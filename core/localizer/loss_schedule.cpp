#include "core/localizer/loss_schedule.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {

LossSchedule::LossSchedule(const FitProblem& problem) : config_(problem.config) { restart(); }

void LossSchedule::restart() {
  loss_ = config_.loss_scale_mm > 0.0 ? config_.loss : Loss::none;
  scale_ = config_.loss_scale_mm;
  rounds_ = 0;
}

double LossSchedule::robust_scale(const PointStore& store, const PointSelection& selection) const {
  std::uint32_t counted = 0;
  double high = 0.0;
  const auto each = [&](auto use) {
    for (std::uint32_t i = 0; i < store.size(); ++i) {
      if (!selection.left_out(store[i], store[i].foot)) use(std::abs(store[i].foot.distance));
    }
  };
  each([&](double d) {
    ++counted;
    high = std::max(high, d);
  });
  double low = 0.0;
  for (int k = 0; k < tuning::kMedianHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    std::uint32_t below = 0;
    each([&](double d) { below += d <= middle ? 1U : 0U; });
    (2 * below >= counted ? high : low) = middle;
  }
  return std::max(config_.noise_floor_mm, tuning::kMedianToScale * high);
}

bool LossSchedule::adapt(const PointStore& store, const PointSelection& selection) {
  if (config_.loss == Loss::none || config_.loss_scale_mm > 0.0) return false;
  if (rounds_++ >= tuning::kScaleRounds) return false;
  const double estimated = robust_scale(store, selection);
  const double change = loss_ == Loss::none ? 1.0 : std::abs(estimated / scale_ - 1.0);
  if (loss_ == config_.loss && change <= tuning::kScaleAtRest) return false;
  if (loss_ == Loss::none) {
    loss_ = Loss::huber;
  } else if (change <= tuning::kScaleNearRest) {
    loss_ = config_.loss;
  }
  scale_ = estimated;
  return true;
}

}  // namespace bladefit
