#include "tools/design/length_unit.hpp"

#include <fmt/format.h>

namespace bladefit {
namespace {

constexpr double kMillimetresPerInch = 25.4;

}  // namespace

DesignUnit shown_unit(const LengthUnit& unit) {
  return unit.mm == kMillimetresPerInch ? DesignUnit::inch : DesignUnit::mm;
}

std::string shown_unit_note(const LengthUnit& unit) {
  if (unit.mm == 1.0 || unit.mm == kMillimetresPerInch) return {};
  return fmt::format("the file's unit is the {} ({} mm); lengths are shown in mm", unit.name, unit.mm);
}

}  // namespace bladefit
