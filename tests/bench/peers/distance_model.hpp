#pragma once
#include <Eigen/Core>

#include "tests/bench/peers/sample_tree.hpp"

namespace bladefit::bench {

/// The oriented distances of a problem's points as functions of six variables x, for solvers that ask for values and
/// first derivatives: the feet are renewed in every evaluation, from those of the one before. Since a foot is a
/// minimum, its motion along the surface adds nothing to the derivative, so that the Jacobian is exact. x = (L w, t):
/// from the start pose the points turn by exp([w]x) about their centroid and shift by t; L is their rms radius, so that
/// all six are lengths of like effect [mm].
class DistanceModel {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

  DistanceModel(const TextbookSurface& surface, int outward, const FitProblem& problem);

  /// Makes distances() and jacobian() those at x; costs nothing when they are already.
  void evaluate(const double* x);

  [[nodiscard]] const Eigen::VectorXd& distances() const { return distances_; }
  [[nodiscard]] const Jacobian& jacobian() const { return jacobian_; }
  [[nodiscard]] Pose pose_at(const double* x) const;
  [[nodiscard]] Eigen::Index size() const { return distances_.size(); }

  /// r of point i at x, and its derivative; for solvers that have the feet as variables of their own.
  struct Moved {
    Eigen::Vector3d r;
    Eigen::Matrix<double, 3, 6> derivative;
  };
  [[nodiscard]] Moved moved_point(std::size_t i, const double* x) const;

 private:
  /// The motion at x, worked out once for all points.
  struct Motion {
    Eigen::Matrix3d rotation, left_jacobian;
    Eigen::Vector3d shift;
  };
  [[nodiscard]] Motion motion_at(const double* x) const;

  const TextbookSurface& surface_;
  double outward_;
  const FitProblem& problem_;
  Eigen::Vector3d centroid_;
  double length_ = 1;
  std::vector<Eigen::Vector3d> arms_;  ///< of the points at the start pose, from the centroid
  std::vector<Parameters> feet_;
  Vector6 x_;
  bool evaluated_ = false;
  Eigen::VectorXd distances_;
  Jacobian jacobian_;
};

}  // namespace bladefit::bench
