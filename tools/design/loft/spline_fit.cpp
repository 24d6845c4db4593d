#include "tools/design/loft/spline_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/surface/design_image.hpp"

namespace bladefit {
namespace {

using Extended = long double;

/// The solution of the normal equations is improved this often by its residual, since they square the condition.
constexpr int kRefinements = 2;

/// The basis functions that are not zero at one parameter; the first belongs to control point `first`.
struct BasisRow {
  std::size_t first = 0;
  std::array<Extended, kMaxDegree + 1> values{};
};

/// The NURBS Book, algorithm A2.2.
BasisRow basis_row(const SurfaceDirection& direction, Extended t) {
  const auto degree = static_cast<std::size_t>(direction.degree);
  const auto inner_end = direction.knots.begin() + direction.control_points;
  const auto above = std::upper_bound(direction.knots.begin() + direction.degree + 1, inner_end, t);
  const auto span = static_cast<std::size_t>(above - direction.knots.begin()) - 1;
  BasisRow row;
  row.first = span - degree;
  row.values[0] = 1;
  for (std::size_t j = 1; j <= degree; ++j) {
    Extended saved = 0;
    for (std::size_t r = 0; r < j; ++r) {
      const Extended right = direction.knots[span + r + 1];
      const Extended left = direction.knots[span + 1 + r - j];
      const Extended part = row.values[r] / (right - left);
      row.values[r] = saved + (right - t) * part;
      saved = (t - left) * part;
    }
    row.values[j] = saved;
  }
  return row;
}

/// Symmetric positive definite matrix with `width` entries a row from the diagonal to the left; factored in place.
class BandMatrix {
 public:
  BandMatrix(std::size_t size, std::size_t width) : size_(size), width_(width), entries_(size * width, 0) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  /// Entry (i, j), i - width < j <= i.
  Extended& at(std::size_t i, std::size_t j) { return entries_[i * width_ + (i - j)]; }
  [[nodiscard]] Extended at(std::size_t i, std::size_t j) const { return entries_[i * width_ + (i - j)]; }

  /// Cholesky's factor takes the place of the matrix. False where it is not positive definite.
  bool factor() {
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t j = leftmost(i); j <= i; ++j) {
        Extended sum = at(i, j);
        for (std::size_t k = leftmost(i); k < j; ++k) {
          if (k >= leftmost(j)) sum -= at(i, k) * at(j, k);
        }
        if (j == i && !(sum > 0)) return false;
        at(i, j) = j == i ? std::sqrt(sum) : sum / at(j, j);
      }
    }
    return true;
  }

  /// Solves with the factor, in place.
  void solve(std::vector<ExtendedPoint>& right) const {
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t k = leftmost(i); k < i; ++k) right[i] -= at(i, k) * right[k];
      right[i] /= at(i, i);
    }
    for (std::size_t i = size_; i-- > 0;) {
      right[i] /= at(i, i);
      for (std::size_t k = leftmost(i); k < i; ++k) right[k] -= at(i, k) * right[i];
    }
  }

 private:
  [[nodiscard]] std::size_t leftmost(std::size_t i) const { return i >= width_ ? i - width_ + 1 : 0; }

  std::size_t size_, width_;
  std::vector<Extended> entries_;
};

/// True where each inner control point has an inner parameter of its own inside its support, in order.
bool determined(const SurfaceDirection& direction, const std::vector<Extended>& parameters) {
  const auto count = static_cast<std::size_t>(direction.control_points);
  std::size_t k = 1;
  for (std::size_t i = 1; i + 1 < count; ++i, ++k) {
    while (k + 1 < parameters.size() && parameters[k] <= direction.knots[i]) ++k;
    const double support_end = direction.knots[i + static_cast<std::size_t>(direction.degree) + 1];
    if (k + 1 >= parameters.size() || parameters[k] >= support_end) return false;
  }
  return true;
}

/// The least-squares problem for the inner control points.
struct SplineProblem {
  std::vector<BasisRow> rows;  ///< one an inner point
  std::size_t degree, last;    ///< last: number of the last control point

  /// N^T N of the inner control points.
  [[nodiscard]] BandMatrix normal_matrix() const {
    BandMatrix matrix(last - 1, degree + 1);
    for (const BasisRow& row : rows) {
      for (std::size_t a = 0; a <= degree; ++a) {
        for (std::size_t b = 0; b <= a; ++b) {
          const std::size_t i = row.first + a;
          const std::size_t j = row.first + b;
          if (j > 0 && i < last) matrix.at(i - 1, j - 1) += row.values[a] * row.values[b];
        }
      }
    }
    return matrix;
  }

  /// N^T (Q - N P): how far the inner points Q are from the spline with control points P, seen by each inner one.
  [[nodiscard]] std::vector<ExtendedPoint> residual(const std::vector<ExtendedPoint>& inner_points,
                                                    const std::vector<ExtendedPoint>& controls) const {
    std::vector<ExtendedPoint> result(last - 1, ExtendedPoint::Zero());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      ExtendedPoint offset = inner_points[k];
      for (std::size_t a = 0; a <= degree; ++a) offset -= rows[k].values[a] * controls[rows[k].first + a];
      for (std::size_t a = 0; a <= degree; ++a) {
        const std::size_t i = rows[k].first + a;
        if (i > 0 && i < last) result[i - 1] += rows[k].values[a] * offset;
      }
    }
    return result;
  }
};

}  // namespace

std::vector<double> uniform_knots(int count) {
  std::vector<double> knots;
  for (int k = 1; k <= count; ++k) knots.push_back(static_cast<double>(k) / (count + 1));
  return knots;
}

std::vector<double> averaged_knots(const std::vector<long double>& parameters, int count) {
  const double step = static_cast<double>(parameters.size()) / (count + 1);
  std::vector<double> knots;
  for (int j = 1; j <= count; ++j) {
    const auto i = static_cast<std::size_t>(j * step);
    const Extended share = static_cast<Extended>(j * step) - static_cast<Extended>(i);
    knots.push_back(static_cast<double>((1 - share) * parameters[i - 1] + share * parameters[i]));
  }
  return knots;
}

SurfaceDirection clamped_direction(int degree, const std::vector<double>& internal) {
  SurfaceDirection direction;
  direction.degree = degree;
  direction.control_points = degree + 1 + static_cast<int>(internal.size());
  const std::size_t ends = static_cast<std::size_t>(degree) + 1;
  direction.knots.assign(ends, 0.0);
  direction.knots.insert(direction.knots.end(), internal.begin(), internal.end());
  direction.knots.insert(direction.knots.end(), ends, 1.0);
  direction.end = 1;
  return direction;
}

std::optional<std::vector<long double>> chord_parameters(const std::vector<ExtendedPoint>& points) {
  std::vector<Extended> parameters{0};
  for (std::size_t k = 1; k < points.size(); ++k) {
    parameters.push_back(parameters.back() + (points[k] - points[k - 1]).norm());
  }
  const Extended length = parameters.back();
  if (!(length > 0)) return std::nullopt;
  for (Extended& parameter : parameters) parameter /= length;
  return parameters;
}

std::optional<std::vector<ExtendedPoint>> fit_spline(const SurfaceDirection& direction,
                                                     const std::vector<long double>& parameters,
                                                     const std::vector<ExtendedPoint>& points) {
  if (!determined(direction, parameters)) return std::nullopt;
  const auto count = static_cast<std::size_t>(direction.control_points);
  SplineProblem problem{{}, static_cast<std::size_t>(direction.degree), count - 1};
  for (std::size_t k = 1; k + 1 < points.size(); ++k) problem.rows.push_back(basis_row(direction, parameters[k]));
  BandMatrix matrix = problem.normal_matrix();
  if (!matrix.factor()) return std::nullopt;
  const std::vector<ExtendedPoint> inner(points.begin() + 1, points.end() - 1);
  std::vector<ExtendedPoint> controls(count, ExtendedPoint::Zero());
  controls.front() = points.front();
  controls.back() = points.back();
  for (int round = 0; round <= kRefinements; ++round) {
    std::vector<ExtendedPoint> step = problem.residual(inner, controls);
    matrix.solve(step);
    for (std::size_t i = 0; i < step.size(); ++i) controls[i + 1] += step[i];
  }
  return controls;
}

}  // namespace bladefit
