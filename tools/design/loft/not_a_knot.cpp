#include "tools/design/loft/not_a_knot.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

namespace bladefit {
namespace {

/// The second derivatives of the spline: it is smooth to the second derivative at all places, to the third at the
/// second and the last but one.
std::vector<double> second_derivatives(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  const auto step = [&x](Eigen::Index k) {
    return x[static_cast<std::size_t>(k) + 1] - x[static_cast<std::size_t>(k)];
  };
  const auto slope = [&](Eigen::Index k) {
    return (y[static_cast<std::size_t>(k) + 1] - y[static_cast<std::size_t>(k)]) / step(k);
  };
  for (Eigen::Index k = 1; k + 1 < count; ++k) {
    system(k, k - 1) = step(k - 1);
    system(k, k) = 2 * (step(k - 1) + step(k));
    system(k, k + 1) = step(k);
    right(k) = 6 * (slope(k) - slope(k - 1));
  }
  const auto same_third = [&](Eigen::Index row, Eigen::Index k) {  // on both sides of place k
    system(row, k - 1) = -step(k);
    system(row, k) = step(k - 1) + step(k);
    system(row, k + 1) = -step(k - 1);
  };
  if (count == 3) {  // a parabola: one second derivative
    system(0, 0) = system(2, 2) = 1;
    system(0, 1) = system(2, 1) = -1;
  } else {
    same_third(0, 1);
    same_third(count - 1, count - 2);
  }
  const Eigen::VectorXd solution = system.partialPivLu().solve(right);
  return {solution.begin(), solution.end()};
}

}  // namespace

NotAKnotSpline::NotAKnotSpline(std::vector<double> places, std::vector<double> values)
    : places_(std::move(places)), values_(std::move(values)), second_(places_.size(), 0.0) {
  if (places_.size() > 2) second_ = second_derivatives(places_, values_);
}

double NotAKnotSpline::at(double place) const {
  const auto after = std::upper_bound(places_.begin() + 1, places_.end() - 1, place);
  const auto k = static_cast<std::size_t>(after - places_.begin());
  const double step = places_[k] - places_[k - 1], a = (places_[k] - place) / step, b = 1 - a;
  return a * values_[k - 1] + b * values_[k] +
         ((a * a * a - a) * second_[k - 1] + (b * b * b - b) * second_[k]) * step * step / 6;
}

}  // namespace bladefit
