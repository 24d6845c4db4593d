#include "tools/batch/outliers.hpp"

#include <algorithm>
#include <cmath>

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

Outliers find_outliers(const FitReport& report, double size_mm, const std::vector<Verdict>& verdicts,
                       const std::vector<ProbePoint>& points) {
  Outliers out;
  const double sigma = report.sigma_mm;
  if (report.determined < report.free || !(sigma > 0.0)) return out;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (!verdicts[i].fitted) continue;
    sizes.push_back(std::sqrt(points[i].weight) * std::abs(verdicts[i].foot.distance));
  }
  if (sizes.empty()) return out;
  out.scale = kMedianToScale * median(sizes);
  out.limit = normal_quantile(kByChance / static_cast<double>(sizes.size()));
  if (!(out.scale > kRounding * size_mm)) return out;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const Verdict& v = verdicts[i];
    if (!v.fitted) continue;
    const double spread = v.uncertainty_mm / sigma, leverage = points[i].weight * spread * spread;
    if (leverage > kMostLeverage) continue;
    const double size = std::sqrt(points[i].weight) * v.foot.distance / (out.scale * std::sqrt(1.0 - leverage));
    if (std::abs(size) > out.limit) out.points.push_back({v.sequence, v.foot.distance, size});
  }
  std::stable_sort(out.points.begin(), out.points.end(), [](const Outlier& a, const Outlier& b) {
    return std::abs(a.studentized) > std::abs(b.studentized);
  });
  return out;
}

}  // namespace bladefit
