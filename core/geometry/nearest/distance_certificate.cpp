#include "core/geometry/nearest/distance_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bladefit {
namespace {

constexpr std::size_t kBinomialRows = 2 * kMaxDegree + 1;

constexpr auto make_binomials() {
  std::array<std::array<double, kBinomialRows>, kBinomialRows> table{};
  for (std::size_t n = 0; n < kBinomialRows; ++n) {
    table[n][0] = 1.0;
    for (std::size_t k = 1; k <= n; ++k) table[n][k] = table[n - 1][k - 1] + (k < n ? table[n - 1][k] : 0.0);
  }
  return table;
}
constexpr auto kBinomial = make_binomials();

constexpr auto make_inverse_binomials() {
  auto table = kBinomial;
  for (auto& row : table) {
    for (double& b : row) b = b > 0.0 ? 1.0 / b : 0.0;
  }
  return table;
}
constexpr auto kInverseBinomial = make_inverse_binomials();

/// Coefficients row by row in u.
template <int Rows, int Columns>
using Coefficients = Eigen::Array<double, Rows, Columns, Eigen::RowMajor>;

constexpr int less(int size) { return size - 1; }

/// Differences of neighbours in u and in v.
template <int R, int C>
Coefficients<less(R), C> rise_u(const Coefficients<R, C>& c) {
  const Eigen::Index rows = c.rows() - 1, columns = c.cols();
  return c.template block<less(R), C>(1, 0, rows, columns) - c.template block<less(R), C>(0, 0, rows, columns);
}
template <int R, int C>
Coefficients<R, less(C)> rise_v(const Coefficients<R, C>& c) {
  const Eigen::Index rows = c.rows(), columns = c.cols() - 1;
  return c.template block<R, less(C)>(0, 1, rows, columns) - c.template block<R, less(C)>(0, 0, rows, columns);
}

/// Extremes of the coefficients times `factor`, made wider by the rounding they may hold.
template <int R, int C>
ValueRange range_of(const Coefficients<R, C>& c, double factor, double rounding) {
  return {factor * (c.minCoeff() - rounding), factor * (c.maxCoeff() + rounding)};
}

template <int R, int C>
DerivativeRanges ranges_of(const Coefficients<R, C>& g, double rounding) {
  const Coefficients<less(R), C> g_u = rise_u<R, C>(g);
  const Coefficients<R, less(C)> g_v = rise_v<R, C>(g);
  const auto m = static_cast<double>(g.rows() - 1), n = static_cast<double>(g.cols() - 1);
  return {range_of<less(R), C>(g_u, m, rounding), range_of<R, less(C)>(g_v, n, rounding),
          range_of<less(less(R)), C>(rise_u<less(R), C>(g_u), m * (m - 1.0), rounding),
          range_of<less(R), less(C)>(rise_v<less(R), C>(g_u), m * n, rounding),
          range_of<R, less(less(C))>(rise_v<R, less(C)>(g_v), n * (n - 1.0), rounding)};
}

/// The same of coefficients of any degree, the differences taken one by one: copies of them would fill the stack.
class AnyRanges {
 public:
  /// c(k, l) = coefficients[k * (n + 1) + l].
  AnyRanges(const double* coefficients, std::uint32_t m, std::uint32_t n) : c_(coefficients), m_(m), n_(n) {}

  [[nodiscard]] DerivativeRanges get(double rounding) const {
    const auto m = static_cast<double>(m_), n = static_cast<double>(n_);
    const auto u = [this](auto k, auto l) { return at(k + 1, l) - at(k, l); };
    const auto v = [this](auto k, auto l) { return at(k, l + 1) - at(k, l); };
    return {range(m_ - 1, n_, m, rounding, u), range(m_, n_ - 1, n, rounding, v),
            range(m_ - 2, n_, m * (m - 1.0), rounding, [&](auto k, auto l) { return u(k + 1, l) - u(k, l); }),
            range(m_ - 1, n_ - 1, m * n, rounding, [&](auto k, auto l) { return u(k, l + 1) - u(k, l); }),
            range(m_, n_ - 2, n * (n - 1.0), rounding, [&](auto k, auto l) { return v(k, l + 1) - v(k, l); })};
  }

 private:
  [[nodiscard]] double at(std::uint32_t k, std::uint32_t l) const { return c_[k * (n_ + 1) + l]; }

  /// As range_of(), of the values with k up to `last_k` and l up to `last_l`.
  template <class Value>
  [[nodiscard]] static ValueRange range(std::uint32_t last_k, std::uint32_t last_l, double factor, double rounding,
                                        Value value) {
    double least = value(0U, 0U), most = least;
    for (std::uint32_t k = 0; k <= last_k; ++k) {
      for (std::uint32_t l = 0; l <= last_l; ++l) {
        const double x = value(k, l);
        least = std::min(least, x);
        most = std::max(most, x);
      }
    }
    return {factor * (least - rounding), factor * (most + rounding)};
  }

  const double* c_;
  std::uint32_t m_, n_;  ///< degrees, 2 at least
};

}  // namespace

DistanceRange distance_range(const BezierNet& net, const Vec3& r) {
  const std::uint32_t count = (net.degree_u + 1) * (net.degree_v + 1);
  const auto offset = [&](const Homogeneous& h) { return Vec3(Vec3(h.head<3>()) / h[3] - r); };
  const Vec3 middle = 0.25 * (offset(net.at(0, 0)) + offset(net.at(0, net.degree_v)) + offset(net.at(net.degree_u, 0)) +
                              offset(net.at(net.degree_u, net.degree_v)));
  DistanceRange range;
  range.middle = middle.norm();
  const Vec3 direction = range.middle > 0.0 ? Vec3(middle / range.middle) : Vec3(Vec3::Zero());
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const Vec3 x = offset(net.points[k]);
    least = std::min(least, direction.dot(x));
    most = std::max(most, x.squaredNorm());
  }
  range.least = std::max(0.0, least);
  range.most = std::sqrt(most);
  return range;
}

/// Net scaled with the binomials, moved to the origin r; the fourth component is bound * w.
template <std::uint32_t DegreeU, std::uint32_t DegreeV>
void DistanceForm::square(const BezierNet& net, const Vec3& r, double bound) {
  const std::uint32_t p = DegreeU != 0 ? DegreeU : net.degree_u, q = DegreeV != 0 ? DegreeV : net.degree_v;
  std::array<Homogeneous, kMaxOrder * kMaxOrder> a;
  const Homogeneous origin(r[0], r[1], r[2], 1.0 - bound);
  for (std::uint32_t i = 0; i <= p; ++i) {
    for (std::uint32_t j = 0; j <= q; ++j) {
      const Homogeneous& point = net.at(i, j);
      a[i * (q + 1) + j] = (kBinomial[p][i] * kBinomial[q][j]) * (point - point[3] * origin);
    }
  }
  m_ = 2 * p;
  n_ = 2 * q;
  const std::uint32_t columns = 2 * q + 1;
  std::fill_n(c_.begin(), (2 * p + 1) * columns, 0.0);
  for (std::uint32_t i = 0; i <= p; ++i) {
    for (std::uint32_t k = i; k <= p; ++k) {
      const double twice = k > i ? 2.0 : 1.0;
      double* row = &c_[(i + k) * columns];
      for (std::uint32_t j = 0; j <= q; ++j) {
        Homogeneous left = twice * a[i * (q + 1) + j];
        left[3] = -left[3];
        for (std::uint32_t l = 0; l <= q; ++l) row[j + l] += (left * a[k * (q + 1) + l]).sum();
      }
    }
  }
  for (std::uint32_t k = 0; k <= m_; ++k) {
    for (std::uint32_t l = 0; l <= n_; ++l) c_[k * columns + l] *= kInverseBinomial[m_][k] * kInverseBinomial[n_][l];
  }
}

DistanceForm::DistanceForm(const BezierNet& net, const Vec3& r, double bound) {
  if (net.degree_u == 3 && net.degree_v == 3) {
    square<3, 3>(net, r, bound);
  } else {
    square<0, 0>(net, r, bound);
  }
  least_weight_ = std::numeric_limits<double>::infinity();
  for (std::uint32_t k = 0; k < (net.degree_u + 1) * (net.degree_v + 1); ++k)
    least_weight_ = std::min(least_weight_, net.points[k][3]);
  size_ = std::abs(at(0, 0)) + std::abs(at(m_, n_)) + bound * bound;
}

bool DistanceForm::farther(double tolerance) const {
  const double least = *std::min_element(c_.begin(), c_.begin() + (m_ + 1) * (n_ + 1));
  return least >= -tolerance * least_weight_ * least_weight_;
}

DerivativeRanges DistanceForm::ranges() const {
  const double rounding = 1e-14 * size_;
  if (m_ == 6 && n_ == 6) return ranges_of<7, 7>(Eigen::Map<const Coefficients<7, 7>>(c_.data()), rounding);
  return AnyRanges(c_.data(), m_, n_).get(rounding);
}

[[gnu::noinline]] DerivativeRanges distance_ranges(const BezierNet& net, const Vec3& r, double bound) {
  return DistanceForm(net, r, bound).ranges();
}

}  // namespace bladefit
