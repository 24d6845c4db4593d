#include "tools/design/nurbs/length_unit.hpp"

#include <fmt/format.h>

#include "drivers/text/units.hpp"

namespace bladefit {

double mm_per_unit(DesignUnit unit) { return unit == DesignUnit::inch ? kMmPerInch : 1.0; }

const char* unit_name(DesignUnit unit) { return unit == DesignUnit::inch ? "in" : "mm"; }

DesignUnit shown_unit(const LengthUnit& unit) { return unit.mm == kMmPerInch ? DesignUnit::inch : DesignUnit::mm; }

std::string shown_unit_note(const LengthUnit& unit) {
  if (unit.mm == 1.0 || unit.mm == kMmPerInch) return {};
  return fmt::format("the file's unit is the {} ({} mm); lengths are shown in mm", unit.name, unit.mm);
}

}  // namespace bladefit
