#pragma once
#include "core/fit/loss.hpp"
#include "core/localizer/point_selection.hpp"

namespace bladefit {

/// The loss in use, with its scale. Where the scale is not given, it is estimated between fits, each time again from
/// the distances of the last one.
class LossSchedule {
 public:
  explicit LossSchedule(const FitProblem& problem);

  /// Back to the loss that holds before anything is known of the distances.
  void restart();
  [[nodiscard]] bool robust() const { return loss_ != Loss::none; }
  /// Standard deviation of good points [mm]; 0 while it is not known.
  [[nodiscard]] double scale() const { return scale_; }
  /// Of the distance d [mm] of a point.
  [[nodiscard]] LossTerms terms(double d) const { return loss_terms(loss_, scale_, d); }
  /// After the fit with one scale has converged: takes the scale of its distances. Tukey's loss has several minima, so
  /// Huber's, which has one, leads to the right one. False: the scale is at rest. Cost: some thirty passes.
  [[nodiscard]] bool adapt(const PointStore& store, const PointSelection& selection);

 private:
  /// 1.4826 times the median distance of the points that count, not below the noise floor [mm].
  [[nodiscard]] double robust_scale(const PointStore& store, const PointSelection& selection) const;

  const LocalizerConfig& config_;
  Loss loss_ = Loss::none;
  double scale_ = 0;
  std::uint32_t rounds_ = 0;  ///< times the scale was estimated
};

}  // namespace bladefit
