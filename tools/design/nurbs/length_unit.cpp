#include "tools/design/nurbs/length_unit.hpp"

#include <fmt/format.h>

namespace bladefit {
namespace {

constexpr double kMillimetresPerInch = 25.4;

}  // namespace

double mm_per_unit(DesignUnit unit) { return unit == DesignUnit::inch ? kMillimetresPerInch : 1.0; }

const char* unit_name(DesignUnit unit) { return unit == DesignUnit::inch ? "in" : "mm"; }

DesignUnit shown_unit(const LengthUnit& unit) {
  return unit.mm == kMillimetresPerInch ? DesignUnit::inch : DesignUnit::mm;
}

std::string shown_unit_note(const LengthUnit& unit) {
  if (unit.mm == 1.0 || unit.mm == kMillimetresPerInch) return {};
  return fmt::format("the file's unit is the {} ({} mm); lengths are shown in mm", unit.name, unit.mm);
}

}  // namespace bladefit
