#include "tools/design/image/normal_cone.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace bladefit {
namespace {

using Extended = long double;
using Vector = Eigen::Matrix<Extended, 3, 1>;

/// Widening of the half angle and of the cosine, for rounding where cones and normals are computed in double.
constexpr double kAngleMargin = 1e-8;
constexpr double kCosineMargin = 1e-15;
/// A control vector this small against the largest one has no reliable direction unless it is exactly zero.
constexpr Extended kNoDirection = 1e-13L;
constexpr int kAxisSteps = 40;

/// A tensor-product polynomial in scaled Bernstein form: entry (i, j) is the control value times
/// C(degree_u, i) C(degree_v, j), so that a product of polynomials is a plain convolution.
template <class Value>
struct Net {
  int degree_u, degree_v;
  std::vector<Value> values;

  [[nodiscard]] std::size_t index(int i, int j) const { return static_cast<std::size_t>(i * (degree_v + 1) + j); }
  [[nodiscard]] const Value& at(int i, int j) const { return values[index(i, j)]; }
  [[nodiscard]] Value& at(int i, int j) { return values[index(i, j)]; }
};

template <class Value>
Net<Value> make_net(int degree_u, int degree_v, const Value& value) {
  return {degree_u, degree_v, std::vector<Value>(static_cast<std::size_t>((degree_u + 1) * (degree_v + 1)), value)};
}

Extended binomial(int n, int k) {
  Extended result = 1;
  for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return result;
}

template <class A, class B, class Value, class Product>
Net<Value> convolve(const Net<A>& a, const Net<B>& b, const Value& zero, Product product) {
  Net<Value> result = make_net(a.degree_u + b.degree_u, a.degree_v + b.degree_v, zero);
  for (int i = 0; i <= a.degree_u; ++i) {
    for (int j = 0; j <= a.degree_v; ++j) {
      for (int k = 0; k <= b.degree_u; ++k) {
        for (int l = 0; l <= b.degree_v; ++l) result.at(i + k, j + l) += product(a.at(i, j), b.at(k, l));
      }
    }
  }
  return result;
}

Net<Vector> cross(const Net<Vector>& a, const Net<Vector>& b) {
  return convolve(a, b, Vector::Zero().eval(), [](const Vector& x, const Vector& y) { return x.cross(y).eval(); });
}

Net<Vector> times(const Net<Extended>& a, const Net<Vector>& b) {
  return convolve(a, b, Vector::Zero().eval(), [](Extended x, const Vector& y) { return (x * y).eval(); });
}

/// d/du in scaled form. With control values b_i = c_i / C(p, i) the derivative has p (b_{i+1} - b_i) of degree p - 1.
template <class Value>
Net<Value> derivative_u(const Net<Value>& net) {
  Net<Value> result = make_net(net.degree_u - 1, net.degree_v, net.values.front());
  for (int i = 0; i < net.degree_u; ++i) {
    for (int j = 0; j <= net.degree_v; ++j) {
      result.at(i, j) =
          net.at(i + 1, j) * static_cast<Extended>(i + 1) - net.at(i, j) * static_cast<Extended>(net.degree_u - i);
    }
  }
  return result;
}

template <class Value>
Net<Value> transposed(const Net<Value>& net) {
  Net<Value> result = make_net(net.degree_v, net.degree_u, net.values.front());
  for (int i = 0; i <= net.degree_u; ++i) {
    for (int j = 0; j <= net.degree_v; ++j) result.at(j, i) = net.at(i, j);
  }
  return result;
}

template <class Value>
Net<Value> derivative_v(const Net<Value>& net) {
  return transposed(derivative_u(transposed(net)));
}

/// The span in homogeneous form: points w (S - centre), whose cross products do not cancel far from the origin.
struct HomogeneousSpan {
  Net<Vector> points;
  Net<Extended> weights;
  bool rational = false;
};

HomogeneousSpan read_span(std::span<const double> coefficients, int degree_u, int degree_v) {
  const auto weight = [&](std::size_t k) { return static_cast<Extended>(coefficients[4 * k + 3]); };
  const auto point = [&](std::size_t k) {
    return Vector(coefficients[4 * k], coefficients[4 * k + 1], coefficients[4 * k + 2]);
  };
  const Vector centre = point(0) / weight(0);
  HomogeneousSpan span{make_net(degree_u, degree_v, Vector::Zero().eval()), make_net(degree_u, degree_v, Extended(0))};
  for (int i = 0; i <= degree_u; ++i) {
    for (int j = 0; j <= degree_v; ++j) {
      const std::size_t k = span.points.index(i, j);
      const Extended scale = binomial(degree_u, i) * binomial(degree_v, j);
      span.points.values[k] = scale * (point(k) - weight(k) * centre);
      span.weights.values[k] = scale * weight(k);
      span.rational = span.rational || weight(k) != weight(0);
    }
  }
  return span;
}

/// Control vectors of a polynomial vector along Su x Sv. With S = A / w, Su x Sv is 1/w^3 times
/// w Au x Av + wv A x Au + wu Av x A, and 1/w^3 is positive.
std::vector<Vector> normal_net(const HomogeneousSpan& span) {
  const Net<Vector> along_u = derivative_u(span.points);
  const Net<Vector> along_v = derivative_v(span.points);
  if (!span.rational) return cross(along_u, along_v).values;
  Net<Vector> sum = times(span.weights, cross(along_u, along_v));
  const Net<Vector> second = times(derivative_v(span.weights), cross(span.points, along_u));
  const Net<Vector> third = times(derivative_u(span.weights), cross(along_v, span.points));
  for (std::size_t k = 0; k < sum.values.size(); ++k) sum.values[k] += second.values[k] + third.values[k];
  return sum.values;
}

/// The axis whose cone about the unit `directions` is nearly the narrowest: steps of falling length towards the
/// farthest one (Badoiu and Clarkson, Smaller core-sets for balls, 2003).
Eigen::Vector3d narrow_axis(const std::vector<Eigen::Vector3d>& directions) {
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& direction : directions) axis += direction;
  if (axis.norm() < 1e-6) return axis;
  axis.normalize();
  Eigen::Vector3d best = axis;
  double best_cosine = -1;
  for (int step = 1; step <= kAxisSteps; ++step) {
    const Eigen::Vector3d* farthest = &directions.front();
    double cosine = axis.dot(*farthest);
    for (const Eigen::Vector3d& direction : directions) {
      const double other = axis.dot(direction);
      if (other >= cosine) continue;
      cosine = other;
      farthest = &direction;
    }
    if (cosine > best_cosine) {
      best_cosine = cosine;
      best = axis;
    }
    axis = (axis + (*farthest - axis) / (step + 1)).normalized();
  }
  return best;
}

}  // namespace

NormalCone normal_cone(std::span<const double> coefficients, int degree_u, int degree_v, int outward) {
  const std::vector<Vector> net = normal_net(read_span(coefficients, degree_u, degree_v));
  Extended largest = 0;
  for (const Vector& vector : net) largest = std::max(largest, vector.norm());
  std::vector<Eigen::Vector3d> directions;
  for (const Vector& vector : net) {
    const Extended length = vector.norm();
    if (length == 0) continue;
    if (!(length > kNoDirection * largest)) return {};
    directions.emplace_back((vector * (outward / length)).cast<double>());
  }
  if (directions.empty()) return {};
  NormalCone cone;
  cone.axis = narrow_axis(directions);
  double cosine = 1;
  for (const Eigen::Vector3d& direction : directions) cosine = std::min(cosine, cone.axis.dot(direction));
  // From a half angle of 90 degrees on the control vectors' cone is not convex and bounds nothing.
  if (!(cosine > kAngleMargin)) return {};
  cone.cosine = std::cos(std::acos(cosine) + kAngleMargin) - kCosineMargin;
  return cone;
}

}  // namespace bladefit
