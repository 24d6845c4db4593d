#pragma once
#include <string>
#include <vector>

#include "tests/support/defect_patterns.hpp"
#include "tests/support/mode_value.hpp"

namespace bladefit::testing {

enum class WayIn : std::uint8_t { batch, stream };

/// How one fit ended, and what is checked of it.
struct DefectFit {
  Status status = Status::ok;  ///< of refine()
  FitReport report;
  double push_s = 0, refine_s = 0;  ///< processor time of taking the points in, and of the fit then
  double least_squares_value =
      0;               ///< of the mode's objective at the least-squares pose; infinite where that is infeasible
  double value = 0;    ///< by the definition, at the pose found
  Pose least_squares;  ///< the pose of that fit
  std::vector<ProbePoint> counted;  ///< points that count in the mode's fit
  std::vector<double> weights;      ///< of these, by the regions that they ended in
  [[nodiscard]] bool answered() const;
  /// Empty: all is well. Else what is wrong with an answer.
  std::string complaint;
};

/// The points that count in a fit that has ended.
[[nodiscard]] std::vector<ProbePoint> counted(const Localizer& fit, const std::vector<ProbePoint>& points);

/// Fits the points as a session does: in batch, or point by point and then refined. Checks that an answer is what its
/// mode's definition says there, not above that of the least-squares pose, and stationary.
[[nodiscard]] DefectFit fit_defects(const CompiledDesign& design, const LocalizerConfig& config,
                                    const std::vector<ProbePoint>& points, WayIn way);

}  // namespace bladefit::testing
