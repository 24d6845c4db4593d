#include "tools/doctor/examine_device.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "drivers/source_uri.hpp"
#include "drivers/text/units.hpp"
#include "tools/doctor/line_examination.hpp"
#include "tools/doctor/modbus_examination.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr double kSameFactor = 1e-9;

/// The setting by which coordinates come out `factor` times as large.
struct ScaleSetting {
  double factor;

  std::string operator()(const ModbusSettings& modbus) const {
    std::string text = "[map.record]";
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double scale = modbus.map.position[axis].scale * factor;
      text += fmt::format("{} {}: scale = {:.10g}", axis == 0 ? "" : ",", "xyz"[axis], scale);
    }
    return text;
  }

  std::string operator()(const DroSettings& dro) const {
    for (const Unit unit : {Unit::mm, Unit::inch, Unit::cm, Unit::metre}) {
      if (std::abs(mm_per_unit(unit) / (dro.mm_per_unit * factor) - 1) < kSameFactor)
        return fmt::format("[dro] units = \"{}\"", word_of(unit));
    }
    return fmt::format("[dro] scale = {:.10g}, where its numbers have no decimal mark; else set the read-out to mm",
                       dro.scale.value_or(1) * factor);
  }

  /// Any other protocol is in millimetres.
  template <typename Settings>
  std::string operator()(const Settings&) const {
    return fmt::format(
        "the device's lengths are to be multiplied by {:.6g}: this protocol is in millimetres, set the device to them",
        factor);
  }
};

/// Why the points cannot be compared with a design; empty = they can.
std::string obstacle(const Examination& examination, const PlacedDesign* design) {
  if (design == nullptr) return "the scale is unproven without a design; name one with --design";
  if (examination.points.size() < kLeastPoints) {
    return fmt::format("the scale is unproven with {} points; probe {} or more, spread over the blade",
                       examination.points.size(), kLeastPoints);
  }
  return "";
}

/// Adds what stands against the points on the design.
void match_points(const SourceSettings& settings, const PlacedDesign& design, Examination& examination) {
  const DesignMatch match = match_design(design, examination.points);
  if (!match.lies_on) {
    examination.outcome = Outcome::undecided;
    examination.conclusion = fmt::format(
        "the points do not come to lie on the design, half of them are {:.3g} mm off or more, nor do they with a scale "
        "of 0.001, 1/25.4, 25.4 or 1000; correct the start pose, or look at the two boxes",
        match.median_mm);
    return;
  }
  examination.seen.push_back(
      fmt::format("half of the points are within {:.3g} mm of the design{}", match.median_mm,
                  match.factor == 1 ? "" : fmt::format(" when they are multiplied by {:.6g}", match.factor)));
  if (match.factor != 1) examination.changes.push_back(std::visit(ScaleSetting{match.factor}, settings));
  if (match.averted) {
    examination.changes.emplace_back(
        std::holds_alternative<ModbusSettings>(settings)
            ? "[map.record] i, j, k: the other sign of scale, since they run out of the material"
            : "nothing for its directions: they run out of the material, set the device to the opposite ones");
  }
}

void conclude(Examination& examination) {
  if (!examination.changes.empty()) {
    const std::string then = examination.conclusion.empty() ? "" : "; then: " + examination.conclusion;
    examination.outcome = Outcome::change;
    examination.conclusion =
        fmt::format("write into the device file: {}{}", fmt::join(examination.changes, "; "), then);
  } else if (examination.outcome == Outcome::fits && examination.conclusion.empty()) {
    examination.conclusion = "the settings make sense of the device, and its points lie on the design";
  } else if (examination.outcome == Outcome::fits) {
    examination.outcome = Outcome::undecided;
    examination.conclusion = "the settings make sense of the device; " + examination.conclusion;
  }
}

}  // namespace

Examination examine_device(const SourceSettings& settings, const PlacedDesign* design, Deadline until) {
  const auto lies_on = [design](const std::vector<ProbePoint>& points) {
    return design == nullptr || points.size() < kLeastPoints || match_design(*design, points).lies_on;
  };
  Examination examination;
  if (const auto* const modbus = std::get_if<ModbusSettings>(&settings)) {
    examination = examine_modbus(*modbus, until, lies_on);
  } else if (const auto* const serial = std::get_if<SerialSettings>(&settings)) {
    examination = examine_line(*serial, until);
  } else if (const auto* const dro = std::get_if<DroSettings>(&settings)) {
    examination = examine_line(*dro, until);
  } else if (std::holds_alternative<ReplaySettings>(settings)) {
    throw ToolError(
        "doctor looks at devices, and this is a recording; name the machine with --source or a device file");
  } else {
    throw ToolError(fmt::format("doctor cannot examine {}; try it with run", source_name(settings)));
  }
  const bool read = examination.outcome == Outcome::fits || examination.outcome == Outcome::change;
  if (!examination.points.empty()) examination.seen.push_back("points: " + box_text(examination.points));
  if (design != nullptr) examination.seen.push_back("design: " + box_text(*design));
  if (read && examination.conclusion.empty()) {
    examination.conclusion = obstacle(examination, design);
    if (examination.conclusion.empty()) match_points(settings, *design, examination);
  }
  conclude(examination);
  return examination;
}

}  // namespace bladefit
