#pragma once
#include <vector>

#include "core/localizer.hpp"
#include "tools/files/rows.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// The middle one of the values, the upper of two; there is at least one.
[[nodiscard]] double median(std::vector<double> values);

/// What of a point and its verdict tells whether it is an outlier.
struct Residual {
  std::uint32_t sequence = 0;
  bool fitted = false;
  double distance_mm = 0, uncertainty_mm = 0, weight = 1;
};
[[nodiscard]] Residual residual_of(const ProbePoint& point, const Verdict& verdict);

/// Studentised residuals of a robust fit, d sqrt(w) / (s sqrt(1 - h)) with the leverage h of the point and s = 1.4826
/// times the median distance, which outliers do not raise. A point is an outlier beyond the limit that one of all
/// points exceeds by chance in 5 of 100 fits with normal errors (Bonferroni). Where s is that of rounding nobody is
/// named. `size_mm`: half diagonal of the design.
[[nodiscard]] Outliers find_outliers(const FitReport& report, double size_mm, const Rows<Residual>& residuals);

}  // namespace bladefit
