#pragma once
#include <vector>

#include "core/localizer.hpp"
#include "tests/support/compiled_design.hpp"

namespace bladefit::testing {

/// The objective of a mode by its definition (tests/data/README.md), over chosen points, with every foot searched
/// again.
class ModeValue {
 public:
  /// `points`: those that count. Minimax and range take them alike, the others by the region of their foot.
  ModeValue(const CompiledDesign& design, const LocalizerConfig& config, std::vector<ProbePoint> points)
      : design_(design), config_(config), points_(std::move(points)) {}

  /// The foot of a point at a pose.
  [[nodiscard]] Foot foot(const ProbePoint& point, const Pose& pose) const;
  /// Bound of a foot: 1 in minimax and range, the tolerance [mm] in constrained, 1 or the ratio in min_tolerance.
  [[nodiscard]] double weight(const Foot& foot) const;
  /// The same of a region, where there is no transition between them.
  [[nodiscard]] double weight(Region region) const;
  /// max |d|, max d - min d, max |d| / w; in constrained and least squares sum d^2 [mm].
  [[nodiscard]] double at(const Pose& pose) const;
  /// The largest |d| / w.
  [[nodiscard]] double largest_ratio(const Pose& pose) const;
  [[nodiscard]] const std::vector<ProbePoint>& points() const { return points_; }
  [[nodiscard]] const CompiledDesign& design() const { return design_; }
  [[nodiscard]] const LocalizerConfig& config() const { return config_; }

 private:
  const CompiledDesign& design_;
  LocalizerConfig config_;
  std::vector<ProbePoint> points_;
};

}  // namespace bladefit::testing
