#pragma once
#include <cstdint>
#include <vector>

#include "core/geometry/surface/surface.hpp"

namespace bladefit {

/// Across which sides of its spans a patch goes on with the same first derivatives, to within rounding.
class SmoothSides {
 public:
  /// Cost: some hundred operations a span.
  explicit SmoothSides(const Surface& surface);

  /// Between a span and the next one along u, or along v; false at the last one.
  [[nodiscard]] bool beyond_high_u(std::uint32_t span) const { return (rough_[span] & kEndsAtHighU) == 0; }
  [[nodiscard]] bool beyond_high_v(std::uint32_t span) const { return (rough_[span] & kEndsAtHighV) == 0; }
  /// The other sides of a span, those on the edges of its patch too: kEndsAt... bits.
  [[nodiscard]] std::uint32_t rough_sides(std::uint32_t span) const { return rough_[span]; }

 private:
  std::vector<std::uint32_t> rough_;
};

}  // namespace bladefit
