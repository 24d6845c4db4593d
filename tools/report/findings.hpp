#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tools/results/result.hpp"

namespace bladefit {

/// What the points of one region came to.
struct RegionFindings {
  std::uint32_t points = 0;  ///< of the region, rejected ones left out
  std::uint32_t cut = 0, weld = 0;
  std::uint32_t beyond = 0;  ///< out beyond an outer edge of the design, where neither is proven
  std::uint32_t pending = 0, undecided = 0;
  std::optional<ResultPoint> worst_out;  ///< the out-of-tolerance point of the largest distance; none is out without

  [[nodiscard]] std::uint32_t out() const { return cut + weld + beyond; }
};

[[nodiscard]] RegionFindings findings_of(const Result& result, Region region);

/// The tolerance by which points of a region were judged [mm]; infinity = not judged, or by zones with limits of their
/// own. In min_tolerance that of the
/// result is the one that was found.
[[nodiscard]] double judged_tolerance(const Result& result, Region region);

/// Points that are not judged.
[[nodiscard]] std::uint32_t rejected_points(const Result& result);

/// The out-of-tolerance points: those of the leading edge first, in each region the largest distance first.
[[nodiscard]] std::vector<ResultPoint> out_of_tolerance(const Result& result);

/// Radius of a measured point about the x axis of the design, moved there by the pose [mm].
[[nodiscard]] double radius_of(const Result& result, const ResultPoint& point);

/// Standard uncertainties of (w, dt) [rad, mm].
[[nodiscard]] std::array<double, 6> standard_uncertainty_of(const Mat6& covariance);

/// The outcome in some words: the head of the report.
[[nodiscard]] std::string headline(const Result& result);

/// What the operator wants to know, one sentence an element, plain text.
[[nodiscard]] std::vector<std::string> summary_sentences(const Result& result);

}  // namespace bladefit
