#include "tools/batch/auto_zone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/design/ridge/ridge_zone.hpp"

namespace bladefit {
namespace {

/// Sections on which the ridge is followed, and places of ridges that an error tells.
constexpr std::size_t kZoneSections = 513, kMostTold = 6;

/// One ridge of a design.
struct RidgeChoice {
  const RidgedBlade* blade = nullptr;
  std::size_t ridge = 0;

  [[nodiscard]] const SectionRidge& middle() const { return blade->middle_of(ridge); }
};

std::string place_text(const RidgeChoice& choice, const FitPlan& plan) {
  const SectionPoint& place = choice.middle().place;
  const Vec3 shown = place.point / plan.mm_per_unit;
  return fmt::format("patch {} u {:.3g} v {:.3g} ({:.4g},{:.4g},{:.4g} {})", place.patch, place.u, place.v, shown.x(),
                     shown.y(), shown.z(), plan.units);
}

[[noreturn]] void refuse(const std::vector<RidgeChoice>& choices, const FitPlan& plan, const std::string& title,
                         const std::string& fix) {
  std::string places;
  for (std::size_t k = 0; k < std::min(choices.size(), kMostTold); ++k)
    places += (k == 0 ? "" : k + 1 == choices.size() ? " and " : ", ") + place_text(choices[k], plan);
  if (choices.size() > kMostTold) places += fmt::format(" and {} more", choices.size() - kMostTold);
  throw ToolError(fmt::format("{}: {} may be the leading edge, in the middle at {}; {}", title,
                              choices.size() == 1 ? "one ridge" : fmt::format("{} ridges", choices.size()), places,
                              fix));
}

/// The point of a section farthest from a ridge: where there is one ridge only, the other edge.
Vec3 farthest_from(const RidgeChoice& choice) {
  const RidgedSection& section = choice.blade->sections[choice.blade->sections.size() / 2];
  const Vec3 place = choice.middle().place.point;
  return std::ranges::max_element(section.line.points, {},
                                  [&place](const SectionPoint& point) { return (point.point - place).squaredNorm(); })
      ->point;
}

/// How far a ridge goes before the other edge of its section when the propeller turns: above 0, it leads [mm].
double lead_of(const RidgeChoice& choice, Rotation rotation, const ShaftAxis& axis) {
  const Vec3 place = choice.middle().place.point;
  const Vec3 other =
      choice.blade->count == 2 ? choice.blade->middle_of(1 - choice.ridge).place.point : farthest_from(choice);
  const Vec3 arm = 0.5 * (place + other) - axis.point;
  const Vec3 motion = axis.direction.cross(arm).normalized();
  return (rotation == Rotation::right ? 1.0 : -1.0) * motion.dot(place - other);
}

RidgeChoice nearest_to(const std::vector<RidgeChoice>& choices, const Vec3& place) {
  return *std::ranges::min_element(
      choices, {}, [&place](const RidgeChoice& choice) { return choice.blade->distance_of(choice.ridge, place); });
}

RidgeChoice leading_edge_of(std::vector<RidgeChoice> choices, const FitSettings& settings, const FitPlan& plan,
                            const std::string& title) {
  constexpr const char* kFix = "add --leading-edge-near x,y,z, a place by the right one";
  if (settings.rotation) {
    const std::vector<RidgeChoice> all = choices;
    std::erase_if(choices, [&](const RidgeChoice& c) { return !(lead_of(c, *settings.rotation, plan.axis) > 0.0); });
    if (choices.empty())
      refuse(all, plan, title, "none of them goes first with this --rotation about --axis; correct one of the two");
  }
  if (settings.leading_edge_near) return nearest_to(choices, *settings.leading_edge_near * plan.mm_per_unit);
  if (choices.size() > 1) {
    refuse(choices, plan, title,
           settings.rotation ? kFix : fmt::format("{}, or --rotation right or left about --axis", kFix));
  }
  return choices.front();
}

/// "0.4 to 0.6", or one number.
std::string span_text(double low, double high) {
  const std::string first = fmt::format("{:.4g}", low), second = fmt::format("{:.4g}", high);
  return first == second ? first : first + " to " + second;
}

/// The parts of a zone on each patch that it touches, with their parameters.
std::string patches_text(const std::vector<ParameterBox>& boxes) {
  std::vector<ParameterBox> parts;
  for (const ParameterBox& box : boxes) {
    const auto own = std::ranges::find_if(parts, [&box](const ParameterBox& part) {
      return part.patch == box.patch && part.u_min <= box.u_max && box.u_min <= part.u_max && part.v_min <= box.v_max &&
             box.v_min <= part.v_max;
    });
    if (own == parts.end()) {
      parts.push_back(box);
      continue;
    }
    *own = {box.patch, std::min(own->u_min, box.u_min), std::max(own->u_max, box.u_max),
            std::min(own->v_min, box.v_min), std::max(own->v_max, box.v_max)};
  }
  std::string text;
  for (const ParameterBox& part : parts) {
    text += fmt::format("{}patch {} u {} v {}", text.empty() ? "" : ", ", part.patch, span_text(part.u_min, part.u_max),
                        span_text(part.v_min, part.v_max));
  }
  return text;
}

std::string zone_note(const EdgeZone& asked, const RidgeZone& zone, const RidgeChoice& choice, const FitPlan& plan) {
  const double unit = plan.mm_per_unit;
  std::string reach =
      fmt::format("{} {}", span_text(zone.least_reach_mm / unit, zone.most_reach_mm / unit), plan.units);
  if (asked.percent) {
    reach += fmt::format(" ({:g} % of chords of {} {})", asked.reach,
                         span_text(zone.least_chord_mm / unit, zone.most_chord_mm / unit), plan.units);
  }
  std::string text = fmt::format(
      "leading edge: the ridge at {}, {:.4g} {} long; its zone: {} along the sections on either side: {}; {} boxes "
      "hold "
      "its limits within {:.2g} {}\n",
      place_text(choice, plan), choice.blade->length_of(choice.ridge) / unit, plan.units, reach,
      patches_text(zone.boxes), zone.boxes.size(), zone.error_mm / unit, plan.units);
  if (zone.clipped) text += "the zone ends where the blade does, or half way round: there it is narrower than asked\n";
  return text;
}

}  // namespace

void plan_auto_zones(const std::vector<NumberedZone>& zones, const FitSettings& settings, const Surface& surface,
                     FitPlan& plan) {
  if (zones.empty()) {
    if (!settings.leading_edge_near && !settings.rotation) return;
    throw ToolError(fmt::format("--{}: only for --leading-edge auto:5mm or auto:3%; leave it out",
                                settings.rotation ? "rotation" : "leading-edge-near"));
  }
  const std::string& title = zones.front().title;
  const std::vector<RidgedBlade> blades = find_ridges(surface, kZoneSections);
  std::vector<RidgeChoice> choices;
  for (const RidgedBlade& blade : blades) {
    for (std::size_t k = 0; k < blade.count; ++k) choices.push_back({&blade, k});
  }
  if (choices.empty()) {
    throw ToolError(
        title +
        ": no section of this design bends by 80 degrees within a tenth of its length, so that no edge is found; give "
        "the zone as [PATCH:]u:0.4:0.6, and see where it is with bladefit show");
  }
  const RidgeChoice choice = leading_edge_of(choices, settings, plan, title);
  ToleranceMap& map = plan.localizer.tolerance;
  const std::size_t most = (ToleranceMap::kMaxBoxes - map.box_count) / zones.size();
  for (const NumberedZone& asked : zones) {
    const RidgeZone zone =
        ridge_zone(surface, *choice.blade, choice.ridge, {asked.zone.reach, asked.zone.percent}, most);
    if (zone.boxes.size() > most) {
      throw ToolError(fmt::format("{}: its zones need more than the {} boxes that are possible; give fewer",
                                  asked.title, ToleranceMap::kMaxBoxes));
    }
    for (ParameterBox box : zone.boxes) {
      box.zone = asked.number;
      map.boxes.at(map.box_count++) = box;
    }
    plan.note += zone_note(asked.zone, zone, choice, plan);
  }
}

void plan_auto_zones(const FitSettings& settings, const Surface& surface, FitPlan& plan) {
  const std::vector<EdgeZone> zones = settings.leading_edge.value_or(std::vector<EdgeZone>());
  std::vector<NumberedZone> automatic;
  for (std::size_t k = 0; k < zones.size(); ++k) {
    if (zones[k].reach > 0) automatic.push_back({zones[k], static_cast<std::uint32_t>(k + 1), "--leading-edge auto"});
  }
  plan_auto_zones(automatic, settings, surface, plan);
}

}  // namespace bladefit
