#include "tools/batch/outliers.hpp"

#include <algorithm>
#include <cmath>

#include "tools/batch/ranked_value.hpp"

namespace bladefit {
namespace {

constexpr double kMedianToScale = 1.4826;
constexpr double kByChance = 0.05;
/// A scale below this, in half diagonals of the design, is rounding.
constexpr double kRounding = 1e-9;
/// A point with more leverage than this determines its own distance: it cannot be judged.
constexpr double kMostLeverage = 0.999;

/// z with P(|normal| > z) = probability, by halving.
double normal_quantile(double probability) {
  double low = 0.0, high = 40.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (std::erfc(middle / std::sqrt(2.0)) > probability ? low : high) = middle;
  }
  return high;
}

}  // namespace

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Residual residual_of(const ProbePoint& point, const Verdict& verdict) {
  return {verdict.sequence, verdict.fitted, verdict.foot.distance, verdict.uncertainty_mm, point.weight};
}

Outliers find_outliers(const FitReport& report, double size_mm, const Rows<Residual>& residuals) {
  Outliers out;
  const double sigma = report.sigma_mm;
  if (report.determined < report.free || !(sigma > 0.0)) return out;
  const auto each_size = [&residuals](const std::function<void(double)>& take) {
    for (const Residual& r : residuals) {
      if (r.fitted) take(std::sqrt(r.weight) * std::abs(r.distance_mm));
    }
  };
  std::size_t fitted = 0;
  each_size([&fitted](double) { ++fitted; });
  if (fitted == 0) return out;
  out.scale = kMedianToScale * ranked_value(fitted / 2, each_size);
  out.limit = normal_quantile(kByChance / static_cast<double>(fitted));
  if (!(out.scale > kRounding * size_mm)) return out;
  for (const Residual& r : residuals) {
    if (!r.fitted) continue;
    const double spread = r.uncertainty_mm / sigma, leverage = r.weight * spread * spread;
    if (leverage > kMostLeverage) continue;
    const double size = std::sqrt(r.weight) * r.distance_mm / (out.scale * std::sqrt(1.0 - leverage));
    if (std::abs(size) > out.limit) out.points.push_back({r.sequence, r.distance_mm, size});
  }
  std::stable_sort(out.points.begin(), out.points.end(), [](const Outlier& a, const Outlier& b) {
    return std::abs(a.studentized) > std::abs(b.studentized);
  });
  return out;
}

}  // namespace bladefit
