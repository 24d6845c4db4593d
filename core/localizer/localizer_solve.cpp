#include <algorithm>
#include <cmath>

#include "core/localizer.hpp"

namespace bladefit {
namespace {

/// A pose does not move further than this in one push [half diagonals]: what lies beyond is no small motion.
constexpr double kLongestStep = 0.05;
/// Directions below this share of the largest eigenvalue are rounding.
constexpr double kNumericalRank = 1e-13;

}  // namespace

/// Finds out which directions the points determine: those whose standard uncertainty is small enough, whatever the
/// noise may be. While points come, what a bad pose leaves over is not noise: a motion may still explain it.
void Localizer::find_determined(const Vec6& x) {
  const QuadraticModel& model = current_.model;
  const MotionSpectrum spectrum = spectrum_of(model, free_motions(pose_, config_.locked, frame_));
  double threshold = kNumericalRank * model.gauss.trace();
  if (!concluded_) {
    const double bound =
        loss_ != Loss::none ? loss_scale_ * loss_scale_ : noise_bound(model, spectrum, x, kLongestStep * frame_.length);
    const double noise = std::max(config_.noise_floor_mm * config_.noise_floor_mm, bound);
    threshold = std::max(threshold, noise / (config_.determined_mm * config_.determined_mm));
  }
  determination_ = determine(model, spectrum, threshold);
  redetermine_ = false;
}

/// Moves the pose to the minimum of the sums in use. Along directions that are not determined a push leads it to the
/// start, since they may have seemed determined before; a refinement leaves it where it is.
/// Returns the length of the step [mm at the half diagonal].
double Localizer::solve() {
  const QuadraticModel& model = current_.model;
  const Vec6 x = motion_between(model.reference, pose_, frame_);
  if (redetermine_ || determination_.rank < 6 || config_.locked != 0) find_determined(x);
  Vec6 from = x;
  if (!refinement_.active && determination_.rank < 6) {
    const Vec6 back = motion_between(model.reference, config_.start, frame_) - x;
    from += determination_.unlocked * (back - determination_.projector * back);
  }
  Vec6 target = minimum_of(model, determination_, from);
  const double length = (target - x).norm();
  if (length > kLongestStep * frame_.length) target = x + (kLongestStep * frame_.length / length) * (target - x);
  if (!tracker_.active()) {
    pose_ = held(moved(model.reference, target, frame_), config_.start, config_.locked);
    ++revision_;
  }
  const auto freedom =
      static_cast<double>(model.count) - static_cast<double>(determination_.rank - determination_.locked);
  const double variance = freedom > 0.0 ? 2.0 * model.value_at(target) / freedom : 0.0;
  sigma_ = std::max(config_.noise_floor_mm, loss_ != Loss::none ? loss_scale_ : std::sqrt(variance));
  const double start = kStartUncertainty * frame_.length;
  covariance_ = unit_covariance(model, determination_, sigma_ * sigma_ / (start * start));
  last_step_ = (target - x).norm();
  return last_step_;
}

}  // namespace bladefit
