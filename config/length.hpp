#pragma once
#include <optional>
#include <string_view>

#include "drivers/source/failure.hpp"
#include "drivers/text/units.hpp"

namespace bladefit {

/// A length as it was given: in a unit of its own, or in that of all lengths.
struct Length {
  double value = 0;
  std::optional<Unit> unit{};

  /// `mm_per_other`: size of the unit of all lengths.
  [[nodiscard]] double in_mm(double mm_per_other) const { return value * (unit ? mm_per_unit(*unit) : mm_per_other); }
  /// In the unit of all lengths.
  [[nodiscard]] double in_units(double mm_per_other) const { return unit ? in_mm(mm_per_other) / mm_per_other : value; }

  friend bool operator==(const Length&, const Length&) = default;
};

/// Reads "0.1", "0.1mm" or "0.004 in". Error: it is no number with a unit or none.
[[nodiscard]] Failure parse_length(std::string_view text, Length& length);

}  // namespace bladefit
