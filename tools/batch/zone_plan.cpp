#include "tools/batch/zone_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/geometry/surface/trim.hpp"
#include "tools/batch/auto_zone.hpp"
#include "tools/batch/tip_radius.hpp"

namespace bladefit {
namespace {

/// Steps over a patch, and over one of many small boxes, at which it is looked for places of a zone.
constexpr std::uint32_t kPatchSteps = 96, kBoxSteps = 12;
/// A band that no place lies in is refused where it is farther than this share of R from all of them; else told.
constexpr double kBandMargin = 0.02;

/// What says the same as the tables in another way.
void check_other_options(const FitSettings& settings) {
  const std::array<std::pair<const char*, bool>, 4> others = {
      {{"--leading-edge", settings.leading_edge.has_value()},
       {"--tolerance", settings.tolerance.has_value()},
       {"--ratio", settings.ratio.has_value()},
       {"--transition", settings.transition.has_value() && *settings.transition > 0}}};
  std::string given;
  for (const auto& [flag, is_given] : others) given += is_given ? (given.empty() ? "" : ", ") + std::string(flag) : "";
  if (given.empty()) return;
  throw ToolError(
      fmt::format("[[zone]] tables and {}: the zones say where which tolerance holds; leave {} out here and in the "
                  "settings file, or leave the zones out (outside of all zones --rest-tolerance holds)",
                  given, given));
}

/// What is seen of a zone on a grid over the design, up to the first place that is its own.
struct Sighting {
  std::uint32_t own = 0;             ///< places that it is the first zone of
  std::uint32_t covered = 0;         ///< its places that are an earlier zone's
  std::size_t covered_by = 0;        ///< one of these
  std::uint32_t on_faces = 0;        ///< places of its boxes, whatever their radius
  double least_mm = 0, most_mm = 0;  ///< radii of those
};

class ZoneSearch {
 public:
  ZoneSearch(const Surface& surface, const LocalizerConfig& fit) : surface_(surface), fit_(fit) {}

  [[nodiscard]] Sighting look_for(std::size_t index) const {
    const ToleranceMap& map = fit_.tolerance;
    Sighting seen;
    if (map.zones.at(index).everywhere) {
      const auto patches = static_cast<std::uint32_t>(surface_.image().patches().size());
      for (std::uint32_t patch = 0; patch < patches; ++patch) look_over({.patch = patch}, kPatchSteps, index, seen);
      return seen;
    }
    const auto whole = std::count_if(map.boxes.begin(), map.boxes.begin() + map.box_count,
                                     [&](const ParameterBox& box) { return box.zone == index + 1; });
    for (std::uint32_t k = 0; k < map.box_count; ++k) {
      if (map.boxes.at(k).zone == index + 1)
        look_over(map.boxes.at(k), whole > 4 ? kBoxSteps : kPatchSteps, index, seen);
    }
    return seen;
  }

 private:
  void look_over(const ParameterBox& box, std::uint32_t steps, std::size_t index, Sighting& seen) const {
    const double low = fit_.window_low, high = fit_.window_high;
    const double u_min = std::max(box.u_min, low), u_max = std::min(box.u_max, high);
    const double v_min = std::max(box.v_min, low), v_max = std::min(box.v_max, high);
    if (u_min > u_max || v_min > v_max) return;
    for (std::uint32_t i = 0; i <= steps; ++i) {
      for (std::uint32_t j = 0; j <= steps; ++j) {
        if (seen.own > 0) return;
        const double u = u_min + (u_max - u_min) * i / steps, v = v_min + (v_max - v_min) * j / steps;
        const SurfacePlace place = surface_.place_at(box.patch, u, v);
        if (inside_face(surface_.image(), place)) look_at(box.patch, u, v, surface_.evaluate(place).s, index, seen);
      }
    }
  }

  void look_at(std::uint32_t patch, double u, double v, const Vec3& point, std::size_t index, Sighting& seen) const {
    const ToleranceMap& map = fit_.tolerance;
    const double radius = map.axis.radius_of(point);
    seen.least_mm = seen.on_faces == 0 ? radius : std::min(seen.least_mm, radius);
    seen.most_mm = std::max(seen.most_mm, radius);
    ++seen.on_faces;
    if (!map.zones.at(index).holds_radius(radius)) return;
    const std::uint32_t first = part_at(map, patch, u, v, point).zone;
    if (first == index + 1) {
      ++seen.own;
    } else if (first != 0) {
      ++seen.covered;
      seen.covered_by = first - 1;
    }
  }

  const Surface& surface_;
  const LocalizerConfig& fit_;
};

/// Refuses a zone in which no point can fall; a line where it may be so thin that its places were not met.
std::string check_place(const ZoneSearch& search, const FitPlan& plan, std::size_t index, double tip_mm) {
  const Sighting seen = search.look_for(index);
  if (seen.own > 0) return "";
  const std::string title = zone_title(plan, index) + ".where";
  if (seen.on_faces == 0) {
    throw ToolError(
        fmt::format("{}: '{}' lies outside of the design's faces or of --window {:g}:{:g}, so that no point can "
                    "fall in it; correct one of them",
                    title, plan.zones.at(index).where, plan.localizer.window_low, plan.localizer.window_high));
  }
  if (seen.covered > 0) {
    throw ToolError(
        fmt::format("{}: all of it lies in {}, which comes first, so that no point can fall in it; put the "
                    "narrower zone first",
                    title, zone_title(plan, seen.covered_by)));
  }
  const ToleranceZone& zone = plan.localizer.tolerance.zones.at(index);
  const std::string met = fmt::format("r/R {:.4g} to {:.4g}", seen.least_mm / tip_mm, seen.most_mm / tip_mm);
  const bool apart = zone.radius_low_mm > seen.most_mm + kBandMargin * tip_mm ||
                     zone.radius_high_mm < seen.least_mm - kBandMargin * tip_mm;
  if (apart) {
    throw ToolError(
        fmt::format("{}: no point can fall in '{}', since its surface has {}; correct the band, or --axis "
                    "and --tip-radius (R {:.6g} {})",
                    title, plan.zones.at(index).where, met, tip_mm / plan.mm_per_unit, plan.units));
  }
  return fmt::format("warning: {}: hardly a place of the design lies in '{}', its surface has {}\n", title,
                     plan.zones.at(index).where, met);
}

/// Boxes of the zones that are given as such; the others are found by their reach.
void add_boxes(const std::vector<ZoneSettings>& zones, const Surface& surface, FitPlan& plan) {
  ToleranceMap& map = plan.localizer.tolerance;
  const std::size_t patches = surface.image().patches().size();
  for (std::size_t k = 0; k < zones.size(); ++k) {
    for (const EdgeZone& edge : zones[k].place.edges) {
      if (edge.reach > 0) continue;
      if (edge.box.patch >= patches) {
        throw ToolError(fmt::format("{}.where: patch {} is not there: the design has {} patch(es), numbered from 0",
                                    zone_title(plan, k), edge.box.patch, patches));
      }
      if (map.box_count == ToleranceMap::kMaxBoxes) {
        throw ToolError(fmt::format("{}.where: the zones need more than the {} boxes that are possible; give fewer",
                                    zone_title(plan, k), ToleranceMap::kMaxBoxes));
      }
      ParameterBox box = edge.box;
      box.zone = static_cast<std::uint32_t>(k + 1);
      map.boxes.at(map.box_count++) = box;
    }
  }
}

std::vector<NumberedZone> automatic_of(const std::vector<ZoneSettings>& zones, const FitPlan& plan) {
  std::vector<NumberedZone> automatic;
  for (std::size_t k = 0; k < zones.size(); ++k) {
    for (const EdgeZone& edge : zones[k].place.edges) {
      if (edge.reach > 0)
        automatic.push_back({edge, static_cast<std::uint32_t>(k + 1), zone_title(plan, k) + ".where"});
    }
  }
  return automatic;
}

}  // namespace

std::string zone_title(const FitPlan& plan, std::size_t index) {
  return fmt::format("zone[{}] \"{}\"", index + 1, plan.zones.at(index).name);
}

void plan_zones(const FitSettings& settings, const Surface& surface, FitPlan& plan) {
  if (!settings.zones) return;
  check_other_options(settings);
  const std::vector<ZoneSettings>& zones = *settings.zones;
  ToleranceMap& map = plan.localizer.tolerance;
  const double tip_mm = plan.tip_radius_mm > 0 ? plan.tip_radius_mm : tip_radius_of(surface, plan.axis);
  map.axis = plan.axis;
  map.zone_count = static_cast<std::uint32_t>(zones.size());
  for (std::size_t k = 0; k < zones.size(); ++k) {
    const ZoneSettings& given = zones[k];
    plan.zones.push_back({given.name, given.where});
    ToleranceZone& zone = map.zones.at(k);
    zone.everywhere = given.place.edges.empty();
    zone.region = zone.everywhere ? Region::rest : Region::leading_edge;
    zone.plus_mm = given.plus.in_mm(plan.mm_per_unit);
    zone.minus_mm = given.minus.in_mm(plan.mm_per_unit);
    if (!given.place.band) continue;
    zone.radius_low_mm = given.place.band->low * tip_mm;
    // R is known to a millionth, and the limit 1.0 means the tip itself.
    zone.radius_high_mm = given.place.band->high * tip_mm * (1.0 + 1e-9);
  }
  add_boxes(zones, surface, plan);
  plan_auto_zones(automatic_of(zones, plan), settings, surface, plan);
  const ZoneSearch search(surface, plan.localizer);
  for (std::size_t k = 0; k < zones.size(); ++k) plan.note += check_place(search, plan, k, tip_mm);
  if (std::isfinite(map.rest_mm)) return;
  plan.note += "outside of the zones nothing is judged, since no --rest-tolerance is given\n";
}

}  // namespace bladefit
