#include "core/localizer/check_config.hpp"

#include <Eigen/LU>
#include <cmath>
#include <string_view>
#include <type_traits>

#include "core/localizer/config_fields.hpp"

namespace bladefit {
namespace {

/// Largest deviation of an entry of C'C from the identity where C is taken for a rotation.
constexpr double kOrthogonal = 1e-9;

/// No length of a blade or a machine is larger [mm], no share or factor either.
constexpr double kLargest = 1e12;

constexpr ConfigFault kNone{};

constexpr ConfigFault out_of_range(const char* field, const char* reason) {
  return {field, reason, Status::out_of_range};
}

ConfigFault check_sizes(const LocalizerConfig& c) {
  if (c.capacity < kLeastCapacity || c.capacity > kMostCapacity)
    return out_of_range("capacity", "must be from 6 to 16777216");
  if (c.refresh_per_push < kLeastRefresh || c.refresh_per_push > kMostRefresh)
    return out_of_range("refresh_per_push", "must be from 2 to 64");
  if (c.tolerance.box_count > ToleranceMap::kMaxBoxes)
    return out_of_range("tolerance.box_count", "must be at most 128");
  if (c.tolerance.zone_count > ToleranceMap::kMaxZones)
    return out_of_range("tolerance.zone_count", "must be at most 16");
  if (c.locked >= kLockAll) return out_of_range("locked", "must leave a degree of freedom free");
  if (c.further_starts > kMostFurtherStarts) return out_of_range("further_starts", "must be at most 12");
  return kNone;
}

/// Every number is finite and of a size that computing with it bears, but a tolerance may be infinite: then nothing is
/// judged by it.
ConfigFault check_finite(const LocalizerConfig& config) {
  ConfigFault fault;
  for_each_field(config, [&fault](const char* name, const auto& field) {
    if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(field)>>) {
      const std::string_view path = name;
      const bool may_be_infinite = path == "tolerance.leading_edge_mm" || path == "tolerance.rest_mm" ||
                                   path == "tolerance.zones.plus_mm" || path == "tolerance.zones.minus_mm" ||
                                   path == "tolerance.zones.radius_high_mm";
      const bool good = may_be_infinite ? !std::isnan(field) : std::isfinite(field);
      if (!good && !fault) fault = {name, "must be a finite number", Status::not_finite};
      if (!fault && std::isfinite(field) && std::abs(field) > kLargest)
        fault = out_of_range(name, "must be at most 1e12");
    }
  });
  return fault;
}

ConfigFault check_tolerance(const ToleranceMap& map, std::size_t patches) {
  if (!(map.leading_edge_mm > 0.0)) return out_of_range("tolerance.leading_edge_mm", "must be above 0");
  if (!(map.rest_mm > 0.0)) return out_of_range("tolerance.rest_mm", "must be above 0");
  if (map.transition < 0.0) return out_of_range("tolerance.transition", "must be 0 or more");
  for (std::uint32_t k = 0; k < map.box_count; ++k) {
    const ParameterBox& box = map.boxes[k];
    if (box.patch >= patches) return out_of_range("tolerance.boxes.patch", "is not a patch of the design");
    if (box.u_min > box.u_max) return out_of_range("tolerance.boxes.u_min", "must not be above u_max");
    if (box.v_min > box.v_max) return out_of_range("tolerance.boxes.v_min", "must not be above v_max");
  }
  return kNone;
}

ConfigFault check_zone(const ToleranceZone& zone) {
  if (!(zone.plus_mm > 0.0)) return out_of_range("tolerance.zones.plus_mm", "must be above 0");
  if (!(zone.minus_mm > 0.0)) return out_of_range("tolerance.zones.minus_mm", "must be above 0");
  if (zone.radius_low_mm < 0.0) return out_of_range("tolerance.zones.radius_low_mm", "must be 0 or more");
  if (!(zone.radius_high_mm > zone.radius_low_mm))
    return out_of_range("tolerance.zones.radius_high_mm", "must be above radius_low_mm");
  return kNone;
}

bool bounds_by_zone(FitMode mode) { return mode == FitMode::min_tolerance || mode == FitMode::constrained; }

/// Tolerances that are bounds, or weights of these: a side without one has no multiple of it, and without one on the
/// rest nothing would hold the blade there.
ConfigFault check_bounding_zones(const ToleranceMap& map) {
  for (std::uint32_t k = 0; k < map.zone_count; ++k) {
    if (std::isfinite(map.zones[k].limits().nearer()) != std::isfinite(map.zones[k].limits().farther())) {
      return out_of_range("tolerance.zones.plus_mm",
                          "must be finite where minus_mm is, in the modes min_tolerance and constrained");
    }
  }
  if (!std::isfinite(map.rest_mm))
    return out_of_range("tolerance.rest_mm", "must be finite in the modes min_tolerance and constrained with zones");
  return kNone;
}

/// A zone that is not everywhere has a box, and every box belongs to one of those.
ConfigFault check_zones(const LocalizerConfig& c) {
  const ToleranceMap& map = c.tolerance;
  if (map.zone_count == 0) return kNone;
  std::uint32_t with_boxes = 0;
  for (std::uint32_t k = 0; k < map.box_count; ++k) {
    const std::uint32_t zone = map.boxes[k].zone;
    if (zone == 0 || zone > map.zone_count || map.zones[zone - 1].everywhere)
      return out_of_range("tolerance.boxes.zone", "must be a zone that is not everywhere");
    with_boxes |= 1U << zone;
  }
  for (std::uint32_t k = 0; k < map.zone_count; ++k) {
    if (const ConfigFault fault = check_zone(map.zones[k])) return fault;
    if (!map.zones[k].everywhere && (with_boxes >> (k + 1) & 1U) == 0)
      return out_of_range("tolerance.zones.everywhere", "must be true of a zone without a box");
  }
  if (map.transition != 0.0) return out_of_range("tolerance.transition", "must be 0 where there are zones");
  if (!(std::abs(map.axis.direction.norm() - 1.0) < kOrthogonal))
    return out_of_range("tolerance.axis.direction", "must be of length 1");
  return bounds_by_zone(c.mode) ? check_bounding_zones(map) : kNone;
}

ConfigFault check_lengths(const LocalizerConfig& c) {
  if (c.probe_radius_mm < 0.0) return out_of_range("probe_radius_mm", "must be 0 or more");
  if (!(c.noise_floor_mm > 0.0)) return out_of_range("noise_floor_mm", "must be above 0");
  if (c.determined_mm < 0.0) return out_of_range("determined_mm", "must be 0 or more");
  if (c.loss_scale_mm < 0.0) return out_of_range("loss_scale_mm", "must be 0 or more");
  if (c.window_low < 0.0 || c.window_low >= c.window_high)
    return out_of_range("window_low", "must be 0 or more and below window_high");
  if (c.window_high > 1.0) return out_of_range("window_high", "must be at most 1");
  return kNone;
}

ConfigFault check_decision(const Decision& decision) {
  if (!(decision.coverage_factor > 0.0)) return out_of_range("decision.coverage_factor", "must be above 0");
  if (decision.probe_mm < 0.0) return out_of_range("decision.probe_mm", "must be 0 or more");
  if (decision.probe_per_mm < 0.0) return out_of_range("decision.probe_per_mm", "must be 0 or more");
  const bool known = decision.probe_mm > 0.0 || decision.probe_per_mm > 0.0;
  if (decision.rule == DecisionRule::guarded && !known)
    return out_of_range("decision.rule", "must be simple where the uncertainty of the probe is not known");
  return kNone;
}

ConfigFault check_modes(const LocalizerConfig& c) {
  if (!(c.ratio >= 1.0)) return out_of_range("ratio", "must be at least 1");
  if (c.mode == FitMode::constrained && !std::isfinite(c.tolerance.rest_mm))
    return out_of_range("tolerance.rest_mm", "must be finite in the constrained mode");
  if (c.loss != Loss::none && c.mode != FitMode::least_squares)
    return out_of_range("loss", "must be none in a mode other than least squares");
  return kNone;
}

ConfigFault check_start(const Pose& start) {
  const Mat3 deviation = start.rotation.transpose() * start.rotation - Mat3::Identity();
  const bool rotation = deviation.cwiseAbs().maxCoeff() < kOrthogonal && start.rotation.determinant() > 0.0;
  return rotation ? kNone : out_of_range("start.rotation", "must be a rotation, orthogonal to 1e-9");
}

}  // namespace

ConfigFault check_config(const LocalizerConfig& config, std::size_t patches) {
  if (const ConfigFault fault = check_sizes(config)) return fault;
  if (const ConfigFault fault = check_finite(config)) return fault;
  if (const ConfigFault fault = check_lengths(config)) return fault;
  if (const ConfigFault fault = check_tolerance(config.tolerance, patches)) return fault;
  if (const ConfigFault fault = check_zones(config)) return fault;
  if (const ConfigFault fault = check_decision(config.decision)) return fault;
  if (const ConfigFault fault = check_modes(config)) return fault;
  return check_start(config.start);
}

}  // namespace bladefit
