#pragma once
#include <vector>

#include "core/localizer.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// Studentised residuals of a least-squares fit, d sqrt(w) / (s sqrt(1 - h)) with the leverage h of the point and s =
/// 1.4826 times the median distance, which outliers do not raise. A point is an outlier beyond the limit that one of
/// all points exceeds by chance in 5 of 100 fits with normal errors (Bonferroni). Empty for other modes.
[[nodiscard]] Outliers find_outliers(const FitReport& report, const LocalizerConfig& config,
                                     const std::vector<Verdict>& verdicts, const std::vector<ProbePoint>& points);

}  // namespace bladefit
