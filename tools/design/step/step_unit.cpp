#include "tools/design/step/step_unit.hpp"

#include <fmt/format.h>
#include <StepBasic_ConversionBasedUnitAndLengthUnit.hxx>
#include <StepBasic_HArray1OfNamedUnit.hxx>
#include <StepBasic_LengthUnit.hxx>
#include <StepBasic_MeasureValueMember.hxx>
#include <StepBasic_MeasureWithUnit.hxx>
#include <StepBasic_SiUnitAndLengthUnit.hxx>
#include <StepBasic_Unit.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>
#include <TCollection_HAsciiString.hxx>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "drivers/text/units.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr double kMillimetresPerMetre = 1000.0;
/// A unit may be defined by another one; more steps than this are a circle.
constexpr int kMaxConversions = 8;

/// The unit of a prefixed metre, or nothing for a prefix that no drawing has.
std::optional<LengthUnit> prefixed_metre(const StepBasic_SiUnit& unit) {
  if (!unit.HasPrefix()) return LengthUnit{kMillimetresPerMetre, "metre"};
  switch (unit.Prefix()) {
    case StepBasic_spKilo:
      return LengthUnit{1e6, "kilometre"};
    case StepBasic_spDeci:
      return LengthUnit{100.0, "decimetre"};
    case StepBasic_spCenti:
      return LengthUnit{10.0, "centimetre"};
    case StepBasic_spMilli:
      return LengthUnit{1.0, "millimetre"};
    case StepBasic_spMicro:
      return LengthUnit{1e-3, "micrometre"};
    default:
      return std::nullopt;
  }
}

/// The unit in mm, or nothing where it is not known. A conversion-based unit, for example the inch, is a number times
/// another unit.
std::optional<LengthUnit> resolve(const Handle(StepBasic_NamedUnit) & unit, int conversions_left) {
  if (const auto si = Handle(StepBasic_SiUnit)::DownCast(unit); !si.IsNull()) {
    return si->Name() == StepBasic_sunMetre ? prefixed_metre(*si) : std::nullopt;
  }
  const auto converted = Handle(StepBasic_ConversionBasedUnit)::DownCast(unit);
  if (converted.IsNull() || converted->ConversionFactor().IsNull() || conversions_left == 0) return std::nullopt;
  const Handle(StepBasic_MeasureWithUnit) factor = converted->ConversionFactor();
  if (factor->ValueComponentMember().IsNull() || factor->UnitComponent().IsNull()) return std::nullopt;
  const std::optional<LengthUnit> base = resolve(factor->UnitComponent().NamedUnit(), conversions_left - 1);
  const double count = factor->ValueComponent();
  if (!base || !std::isfinite(count) || count <= 0) return std::nullopt;
  return LengthUnit{count * base->mm, converted->Name().IsNull() ? "unit" : converted->Name()->ToCString()};
}

/// False for an inch or foot of another length: then one of the two is wrong, and every length with it.
bool is_what_its_name_says(const LengthUnit& unit) {
  constexpr double kRounding = 1e-5;
  std::string name = unit.name;
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const double meant = name == "INCH" || name == "INCHES" ? kMmPerInch
                       : name == "FOOT" || name == "FEET" ? 12 * kMmPerInch
                                                          : 0;
  return meant == 0 || std::abs(unit.mm - meant) <= kRounding * meant;
}

bool is_length(const Handle(StepBasic_NamedUnit) & unit) {
  return unit->IsKind(STANDARD_TYPE(StepBasic_SiUnitAndLengthUnit)) ||
         unit->IsKind(STANDARD_TYPE(StepBasic_ConversionBasedUnitAndLengthUnit)) ||
         unit->IsKind(STANDARD_TYPE(StepBasic_LengthUnit));
}

Handle(StepBasic_HArray1OfNamedUnit) units_of(const Handle(Standard_Transient) & entity) {
  using Uncertain = StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx;
  using Plain = StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext;
  Handle(StepRepr_GlobalUnitAssignedContext) context = Handle(StepRepr_GlobalUnitAssignedContext)::DownCast(entity);
  if (const auto uncertain = Handle(Uncertain)::DownCast(entity); !uncertain.IsNull()) {
    context = uncertain->GlobalUnitAssignedContext();
  }
  if (const auto plain = Handle(Plain)::DownCast(entity); !plain.IsNull()) context = plain->GlobalUnitAssignedContext();
  return context.IsNull() ? Handle(StepBasic_HArray1OfNamedUnit)() : context->Units();
}

}  // namespace

LengthUnit read_step_unit(const StepData_StepModel& model, const std::string& file) {
  std::optional<LengthUnit> found;
  for (int k = 1; k <= model.NbEntities(); ++k) {
    const Handle(StepBasic_HArray1OfNamedUnit) units = units_of(model.Value(k));
    if (units.IsNull()) continue;
    for (const Handle(StepBasic_NamedUnit) & unit : *units) {
      if (unit.IsNull() || !is_length(unit)) continue;
      const std::optional<LengthUnit> length = resolve(unit, kMaxConversions);
      if (!length) {
        throw ToolError(fmt::format("{}: #{}: unknown unit of length; export the design in mm or inches", file,
                                    model.IdentLabel(unit)));
      }
      if (!is_what_its_name_says(*length)) {
        throw ToolError(fmt::format("{}: #{}: the unit {} is {} mm in this file; export the design in mm or inches",
                                    file, model.IdentLabel(unit), length->name, length->mm));
      }
      if (found && found->mm != length->mm) {
        throw ToolError(
            fmt::format("{}: #{}: the file mixes units of length ({} mm and {} mm); export the design in "
                        "one unit",
                        file, model.IdentLabel(unit), found->mm, length->mm));
      }
      found = length;
    }
  }
  if (found) return *found;
  throw ToolError(
      fmt::format("{}: no unit of length (GLOBAL_UNIT_ASSIGNED_CONTEXT) in the file; export the design "
                  "in mm or inches",
                  file));
}

}  // namespace bladefit
