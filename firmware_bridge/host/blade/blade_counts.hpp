#pragma once
#include <array>
#include <cstdint>
#include <map>

#include "firmware_bridge/host/blade/blade_layout.hpp"

namespace bladefit {

/// How many points have which verdict in which part of the blade. Cost of a verdict: constant, logarithmic where it is
/// out.
class BladeCounts {
 public:
  /// `layout` must outlive it.
  explicit BladeCounts(const BladeLayout& layout) : layout_(&layout) {}

  /// `sign`: +1 to add a point, -1 to take it back.
  void count(const Verdict& verdict, int sign);
  void clear();

  [[nodiscard]] EdgeCell edge_cell(std::size_t cell) const;
  /// Points off the leading edge on a side, in a tenth of r/R.
  [[nodiscard]] std::uint32_t points(BladeSide side, std::size_t band) const;
  /// Sum of J^T J over the points: what they tell of motions (turn times the layout's scale, shift) about its middle.
  [[nodiscard]] const Mat6& information() const { return information_; }
  /// Points that are out, by sequence, as they were judged last.
  [[nodiscard]] const std::map<std::uint32_t, Verdict>& out() const { return out_; }

 private:
  static constexpr std::size_t kKinds = 7;  ///< of EdgeCell
  const BladeLayout* layout_;
  std::array<std::array<std::uint32_t, kKinds>, BladeView::kCells> edge_{};
  std::array<std::array<std::uint32_t, BladeView::kBands>, 2> sides_{};
  Mat6 information_ = Mat6::Zero();
  std::map<std::uint32_t, Verdict> out_;
};

/// The row of a point in a fit: how its distance changes with motions of the design's scale about its middle.
[[nodiscard]] Vec6 motion_row(const BladeLayout& layout, const Vec3& point, const Vec3& normal);

}  // namespace bladefit
