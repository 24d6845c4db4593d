#pragma once
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tools/report/colour_scale.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// Distances as shares of what is allowed there: the scale of pictures in which regions of different tolerances stand
/// side by side. Where nothing is judged, shares of the largest distance.
struct ToleranceScale {
  double largest = 1;  ///< of the points that count [mm], > 0
  bool in_tolerances = true;

  [[nodiscard]] double share(const ResultPoint& point) const {
    const bool judged = in_tolerances && std::isfinite(point.tolerance) && point.tolerance > 0;
    return point.distance / (judged ? point.tolerance : largest);
  }
  /// Full colour at the tolerance.
  [[nodiscard]] ColourScale colours() const { return {1.0}; }
};

[[nodiscard]] ToleranceScale tolerance_scale_of(const Result& result);

/// Which points a picture shows, as indices of the result's points in the order of drawing, the worst last: where there
/// are too many, all that are out, up to kMostOutDrawn of the worst, and evenly chosen others.
struct DrawnPoints {
  std::vector<std::size_t> indices;
  std::size_t left_out = 0;
};
inline constexpr std::size_t kMostOutDrawn = 1500, kMostDrawn = 5000;

[[nodiscard]] DrawnPoints drawn_points_of(const Result& result, const ToleranceScale& scale);

/// "of 150,000 points 5,000 are drawn: ..."; empty where all are.
[[nodiscard]] std::string thinned_note(const Result& result, const DrawnPoints& drawn);

}  // namespace bladefit
