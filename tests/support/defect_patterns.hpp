#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/localizer.hpp"
#include "tests/support/reference_design.hpp"

namespace bladefit::testing {

/// Points of a case with made-up defects, and the tolerances of its constrained fit.
struct DefectPattern {
  std::vector<ProbePoint> points;  ///< each with a probing direction
  double leading_edge_mm = 0, rest_mm = 0;
  std::string text;  ///< what was made
};

/// Spots of excess and missing material on the measured points of a case: one to six spots of one to ten neighbouring
/// points, 0.05 to 2 mm, at the leading edge, near the ends of the span or anywhere. A touch on excess material comes
/// early along the probing direction, one on missing material late. Where the case has no probing directions they are
/// those of the normals at its least-squares fit.
class DefectPatterns {
 public:
  /// `subset`: full, or all with the points beyond the border of the blade.
  DefectPatterns(const ReferenceCase& c, const std::string& subset);

  /// The same pattern for the same seed, on every machine.
  [[nodiscard]] DefectPattern make(std::uint64_t seed) const;

 private:
  enum class Zone : std::uint8_t { leading_edge, span_end, anywhere };
  [[nodiscard]] Zone zone_of(const Verdict& verdict) const;
  [[nodiscard]] std::vector<std::size_t> members(const std::vector<std::size_t>& kept, Zone zone) const;

  const ReferenceCase& case_;
  std::vector<ProbePoint> points_;
  std::vector<Zone> zones_;
  double rms_mm_ = 0;
};

}  // namespace bladefit::testing
