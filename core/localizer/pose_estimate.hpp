#pragma once
#include "core/fit/pose_solver.hpp"
#include "core/localizer/loss_schedule.hpp"

namespace bladefit {

/// Minimum of the sums, as far as the points determine it.
struct Minimum {
  Pose pose;
  Determination determination;
  Mat6 covariance;  ///< of x, for unit variance
  double sigma;     ///< of a distance [mm], not below the noise floor
  double step;      ///< from the present pose to the minimum [mm at the half diagonal]
};

/// The pose, and how well it is known. move_to() is the only writer of the pose, and counts the revision.
class PoseEstimate {
 public:
  explicit PoseEstimate(const FitProblem& problem) : problem_(problem) {}

  /// Back to the start pose. `model`: the empty sums there.
  void reset(const QuadraticModel& model);

  /// Where directions that are not determined lead: back to the start, since they may have seemed determined before, or
  /// nowhere.
  enum class Undetermined : std::uint8_t { to_start, as_they_are };
  /// Minimum of the sums from the present pose, at most the reach away. Which directions are determined is found out
  /// again where redetermine() asked for it or not all are. `concluded`: every direction that the points determine at
  /// all is used, however weakly.
  [[nodiscard]] Minimum minimum_of(const QuadraticModel& model, const LossSchedule& loss, bool concluded,
                                   Undetermined undetermined) const;
  /// Takes over all of it but the pose.
  void know(const Minimum& minimum);
  void move_to(const Pose& pose);
  /// Sums of other points are in use: which directions are determined is to be found out again.
  void redetermine() { redetermine_ = true; }
  /// Length of a step that did not come from a minimum [mm at the half diagonal].
  void set_last_step(double length) { last_step_ = length; }

  [[nodiscard]] const Pose& pose() const { return pose_; }
  [[nodiscard]] std::uint32_t revision() const { return revision_; }
  [[nodiscard]] const Determination& determination() const { return determination_; }
  [[nodiscard]] bool determined() const { return determination_.rank == 6; }
  [[nodiscard]] const Mat6& covariance() const { return covariance_; }
  [[nodiscard]] double sigma() const { return sigma_; }
  [[nodiscard]] double last_step() const { return last_step_; }

  /// Standard uncertainty of a distance that comes from the pose, and how far directions that are not determined may
  /// change it, were the start pose off by its assumed uncertainty [mm].
  struct DistanceUncertainty {
    double standard = 0, undetermined = 0;
  };
  /// Of a point of the machine with this foot.
  [[nodiscard]] DistanceUncertainty uncertainty_of(const Vec3& position, const Foot& foot) const;

 private:
  [[nodiscard]] Determination determination_of(const QuadraticModel& model, const Vec6& x, const LossSchedule& loss,
                                               bool concluded) const;

  const FitProblem& problem_;
  Pose pose_;
  Determination determination_;
  Mat6 covariance_ = Mat6::Identity();  ///< of x, for unit variance
  double sigma_ = 0;
  double last_step_ = 0;
  std::uint32_t revision_ = 0;
  bool redetermine_ = true;
};

}  // namespace bladefit
