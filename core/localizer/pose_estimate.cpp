#include "core/localizer/pose_estimate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bladefit {

void PoseEstimate::reset(const QuadraticModel& model) {
  pose_ = problem_.config.start;
  determination_ = Determination();
  determination_.free_directions = Mat6::Identity();
  covariance_ = unit_covariance(model, determination_, 1.0);
  sigma_ = problem_.config.noise_floor_mm;
  last_step_ = 0;
  revision_ = 0;
  redetermine_ = true;
}

/// Which directions the points determine: those whose standard uncertainty is small enough, whatever the noise may be.
/// While points come, what a bad pose leaves over is not noise: a motion may still explain it.
Determination PoseEstimate::determination_of(const QuadraticModel& model, const Vec6& x, const LossSchedule& loss,
                                             bool concluded) const {
  const LocalizerConfig& config = problem_.config;
  const MotionSpectrum spectrum = spectrum_of(model, free_motions(pose_, config.locked, problem_.frame));
  double threshold = tuning::kNumericalRank * model.gauss.trace();
  if (!concluded) {
    const double bound =
        loss.robust() ? loss.scale() * loss.scale() : noise_bound(model, spectrum, x, problem_.reach());
    const double noise = std::max(config.noise_floor_mm * config.noise_floor_mm, bound);
    threshold = std::max(threshold, noise / (config.determined_mm * config.determined_mm));
  }
  return determine(model, spectrum, threshold);
}

Minimum PoseEstimate::minimum_of(const QuadraticModel& model, const LossSchedule& loss, bool concluded,
                                 Undetermined undetermined) const {
  const LocalizerConfig& config = problem_.config;
  const MotionFrame& frame = problem_.frame;
  Minimum out;
  const Vec6 x = motion_between(model.reference, pose_, frame);
  const bool find_out = redetermine_ || determination_.rank < 6 || config.locked != 0;
  out.determination = find_out ? determination_of(model, x, loss, concluded) : determination_;
  const Determination& known = out.determination;
  Vec6 from = x;
  if (undetermined == Undetermined::to_start && known.rank < 6) {
    const Vec6 back = motion_between(model.reference, config.start, frame) - x;
    from += known.unlocked * (back - known.projector * back);
  }
  Vec6 target = bladefit::minimum_of(model, known, from);
  const double length = (target - x).norm();
  if (length > problem_.reach()) target = x + (problem_.reach() / length) * (target - x);
  out.pose = problem_.moved_and_held(model.reference, target);
  const auto freedom = static_cast<double>(model.count) - static_cast<double>(known.rank - known.locked);
  const double variance = freedom > 0.0 ? 2.0 * model.value_at(target) / freedom : 0.0;
  out.sigma = std::max(config.noise_floor_mm, loss.robust() ? loss.scale() : std::sqrt(variance));
  const double start = tuning::kStartUncertainty * frame.length;
  out.covariance = unit_covariance(model, known, out.sigma * out.sigma / (start * start));
  out.step = (target - x).norm();
  return out;
}

void PoseEstimate::know(const Minimum& minimum) {
  determination_ = minimum.determination;
  covariance_ = minimum.covariance;
  sigma_ = minimum.sigma;
  last_step_ = minimum.step;
  redetermine_ = false;
}

void PoseEstimate::move_to(const Pose& pose) {
  pose_ = pose;
  ++revision_;
}

PoseEstimate::DistanceUncertainty PoseEstimate::uncertainty_of(const Vec3& position, const Foot& foot) const {
  const MotionFrame& frame = problem_.frame;
  Vec6 gradient;
  gradient.head<3>() = (apply(pose_, position) - frame.pivot).cross(foot.normal) / frame.length;
  gradient.tail<3>() = foot.normal;
  const double free = determination_.rank == 6 ? 0.0 : (determination_.free_directions.transpose() * gradient).norm();
  return {sigma_ * std::sqrt(std::max(0.0, gradient.dot(covariance_ * gradient))),
          free * tuning::kStartUncertainty * frame.length};
}

}  // namespace bladefit
