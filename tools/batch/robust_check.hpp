#pragma once
#include "tools/batch/result_record.hpp"

namespace bladefit {

/// What a fit that outliers do not pull says of the same points.
struct RobustCheck {
  Outliers outliers;  ///< by its distances: there outliers hide neither each other nor themselves
  /// Points that it judges otherwise, in instead of out or the reverse: clustered defects draw a least-squares fit
  /// towards themselves.
  std::vector<std::uint32_t> judged_otherwise;
};

/// Fits the points of a least-squares fit without a loss once more, with Tukey's loss; a fit that has a loss speaks for
/// itself. Empty for other modes, where fit or robust fit has not converged, and where it cannot tell.
[[nodiscard]] RobustCheck check_robustly(const FinishedFit& fit);

}  // namespace bladefit
