#pragma once
#include <string>

#include "core/geometry/surface/design_image.hpp"

namespace bladefit {

/// A unit of length in a CAD file.
struct LengthUnit {
  double mm;         ///< its length [mm]
  std::string name;  ///< "millimetre", "inch", ...
};

/// Length of one of the two units of the house [mm].
double mm_per_unit(DesignUnit unit);

/// "mm" or "in".
const char* unit_name(DesignUnit unit);

/// In which of the two units of the house lengths of a file in `unit` are shown: inch for inch, mm for all others.
DesignUnit shown_unit(const LengthUnit& unit);

/// One line that says so where `unit` is neither mm nor inch; empty otherwise.
std::string shown_unit_note(const LengthUnit& unit);

}  // namespace bladefit
