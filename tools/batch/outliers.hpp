#pragma once
#include <cstdint>
#include <vector>

#include "core/localizer.hpp"

namespace bladefit {

/// A point that does not belong to the others: a chip under the probe, a wrong touch, or a defect of the blade.
struct AberrantPoint {
  std::uint32_t sequence = 0;
  double distance_mm = 0;
  double studentized = 0;  ///< distance / its standard deviation, signed
};

struct AberrantPoints {
  std::vector<AberrantPoint> points;  ///< the largest first
  double limit = 0;                   ///< beyond which a point is aberrant
  double scale_mm = 0;                ///< robust standard deviation of a distance of weight 1
};

/// Studentised residuals of a least-squares fit, d sqrt(w) / (s sqrt(1 - h)) with the leverage h of the point and s =
/// 1.4826 times the median distance, which aberrant points do not raise. A point is aberrant beyond the limit that one
/// of all points exceeds by chance in 5 of 100 fits with normal errors (Bonferroni). Empty for other modes.
[[nodiscard]] AberrantPoints aberrant_points(const FitReport& report, const LocalizerConfig& config,
                                             const std::vector<Verdict>& verdicts,
                                             const std::vector<ProbePoint>& points);

}  // namespace bladefit
