#include "firmware_bridge/abi_conversion.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "core/localizer/check_config.hpp"

namespace bladefit {
namespace {

static_assert(BLADEFIT_MAX_BOXES <= ToleranceMap::kMaxBoxes && BLADEFIT_MAX_CAPACITY == kMostCapacity);
static_assert(BLADEFIT_MAX_ZONES == ToleranceMap::kMaxZones && BLADEFIT_MAX_ZONE_BOXES == ToleranceMap::kMaxBoxes);
static_assert(BLADEFIT_NOT_FINITE == static_cast<int>(Status::not_finite) &&
              BLADEFIT_OUT_OF_RANGE == static_cast<int>(Status::out_of_range));

Mat3 rotation_from(const double (&rows)[9]) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows);
}

/// What the core's narrower types cannot hold, which check_config() therefore cannot see.
bool numbers_fit(const bladefit_config& config) {
  const auto reserved = [](const bladefit_box& box) { return box.reserved != 0; };
  if (config.reserved != 0 || config.box_count > BLADEFIT_MAX_BOXES) return false;
  if (std::ranges::any_of(std::span(config.boxes).first(config.box_count), reserved)) return false;
  return config.use_approach <= 1 && config.edges <= BLADEFIT_EDGES_USE && config.mode < kFitModeWords.size() &&
         config.regions <= BLADEFIT_REGIONS_FIXED && config.locked <= kLockAll && config.loss <= BLADEFIT_LOSS_TUKEY &&
         config.decision <= BLADEFIT_GUARDED;
}

ParameterBox box_from(const bladefit_box& box, std::uint32_t zone) {
  return {box.patch, box.u_min, box.u_max, box.v_min, box.v_max, zone};
}

ToleranceMap tolerance_from(const bladefit_config& config) {
  ToleranceMap map;
  map.box_count = config.box_count;
  std::ranges::transform(std::span(config.boxes).first(config.box_count), map.boxes.begin(),
                         [](const bladefit_box& box) { return box_from(box, 0); });
  map.leading_edge_mm = config.leading_edge_tolerance_mm;
  map.rest_mm = config.rest_tolerance_mm;
  map.transition = config.transition;
  return map;
}

bladefit_region_report translate_region(const RegionReport& from) {
  return {from.count, from.judged_out, from.worst_sequence, 0, from.rms_mm, from.worst_mm};
}

bladefit_certificate translate_certificate(const Certificate& from) {
  bladefit_certificate to{};
  to.count = from.count;
  std::ranges::copy(from.sequence, to.sequence);
  std::ranges::copy(from.sign, to.sign);
  std::ranges::copy(from.multiplier, to.multiplier);
  return to;
}

bladefit_status check_zone(const bladefit_zone& zone) {
  if (zone.struct_size != sizeof(bladefit_zone)) return BLADEFIT_BAD_SIZE;
  if (zone.reserved != 0 || zone.region > BLADEFIT_LEADING_EDGE) return BLADEFIT_OUT_OF_RANGE;
  if (zone.box_count == 0) return BLADEFIT_OK;
  if (zone.boxes == nullptr) return BLADEFIT_NULL_ARGUMENT;
  return reinterpret_cast<std::uintptr_t>(zone.boxes) % alignof(bladefit_box) == 0 ? BLADEFIT_OK : BLADEFIT_MISALIGNED;
}

/// Adds zone number `number`, from 1.
bladefit_status add_zone(const bladefit_zone& from, std::uint32_t number, ToleranceMap& map) {
  if (const bladefit_status status = check_zone(from); status != BLADEFIT_OK) return status;
  if (from.box_count > BLADEFIT_MAX_ZONE_BOXES - map.box_count) return BLADEFIT_OUT_OF_RANGE;
  for (std::uint32_t k = 0; k < from.box_count; ++k) {
    if (from.boxes[k].reserved != 0) return BLADEFIT_OUT_OF_RANGE;
    map.boxes[map.box_count++] = box_from(from.boxes[k], number);
  }
  map.zones[number - 1] = {static_cast<Region>(from.region),
                           from.box_count == 0,
                           from.radius_low_mm,
                           from.radius_high_mm,
                           from.plus_mm,
                           from.minus_mm};
  return BLADEFIT_OK;
}

}  // namespace

bladefit_status translate_zones(std::span<const bladefit_zone> zones, const bladefit_axis* axis, ToleranceMap& map) {
  if (zones.empty() || zones.size() > BLADEFIT_MAX_ZONES) return BLADEFIT_OUT_OF_RANGE;
  map.box_count = 0;
  map.zone_count = static_cast<std::uint32_t>(zones.size());
  map.axis = ShaftAxis();
  for (std::uint32_t k = 0; k < map.zone_count; ++k) {
    if (const bladefit_status status = add_zone(zones[k], k + 1, map); status != BLADEFIT_OK) return status;
  }
  if (axis == nullptr) return BLADEFIT_OK;
  if (axis->reserved != 0) return BLADEFIT_OUT_OF_RANGE;
  map.axis = {Eigen::Map<const Vec3>(axis->point), Eigen::Map<const Vec3>(axis->direction)};
  return BLADEFIT_OK;
}

bladefit_status translate_config(const bladefit_config& from, LocalizerConfig& to) {
  if (!numbers_fit(from)) return BLADEFIT_OUT_OF_RANGE;
  to.capacity = from.capacity;
  to.refresh_per_push = from.refresh_per_push;
  to.probe_radius_mm = from.probe_radius_mm;
  to.use_approach = from.use_approach == 1;
  to.edges = static_cast<EdgePolicy>(from.edges);
  to.noise_floor_mm = from.noise_floor_mm;
  to.determined_mm = from.determined_mm;
  to.window_low = from.window_low;
  to.window_high = from.window_high;
  to.start = {rotation_from(from.start_rotation), Eigen::Map<const Vec3>(from.start_translation)};
  to.tolerance = tolerance_from(from);
  to.mode = static_cast<FitMode>(from.mode);
  to.regions = static_cast<RegionPolicy>(from.regions);
  to.locked = static_cast<std::uint8_t>(from.locked);
  to.loss = static_cast<Loss>(from.loss);
  to.loss_scale_mm = from.loss_scale_mm;
  to.ratio = from.ratio == 0 ? 10.0 : from.ratio;
  to.decision.rule = static_cast<DecisionRule>(from.decision);
  to.decision.coverage_factor = from.coverage_factor == 0 ? 2.0 : from.coverage_factor;
  to.decision.probe_mm = from.probe_uncertainty_mm;
  to.decision.probe_per_mm = from.probe_uncertainty_per_mm;
  return static_cast<bladefit_status>(check_config(to, kAnyPatches).status);
}

bladefit_status translate_point(const bladefit_point& from, ProbePoint& to) {
  if (from.reserved != 0 || from.path > std::numeric_limits<std::uint16_t>::max()) return BLADEFIT_OUT_OF_RANGE;
  to.sequence = from.sequence;
  to.path = static_cast<std::uint16_t>(from.path);
  std::ranges::copy(from.position, to.position.begin());
  std::ranges::copy(from.approach, to.approach.begin());
  to.weight = from.weight == 0 ? 1.0 : from.weight;
  return BLADEFIT_OK;
}

bladefit_verdict translate_verdict(const Verdict& from) {
  bladefit_verdict to{};
  to.struct_size = sizeof to;
  to.sequence = from.sequence;
  to.patch = from.foot.patch;
  to.kind = static_cast<std::uint32_t>(from.foot.kind);
  to.region = static_cast<std::uint32_t>(from.region);
  to.state = static_cast<std::uint32_t>(from.state);
  to.action = static_cast<std::uint32_t>(from.action);
  to.fit_revision = from.revision;
  to.u = from.foot.u;
  to.v = from.foot.v;
  std::ranges::copy(from.foot.point, to.foot);
  std::ranges::copy(from.foot.normal, to.normal);
  to.distance_mm = from.foot.distance;
  to.tolerance_mm = from.tolerance_mm;
  to.uncertainty_mm = from.uncertainty_mm;
  to.expanded_mm = from.expanded_mm;
  to.beyond_mm = from.foot.beyond;
  to.left_out = static_cast<std::uint32_t>(from.left_out);
  to.fitted = from.fitted ? 1 : 0;
  return to;
}

bladefit_fit_report translate_report(const FitReport& from) {
  bladefit_fit_report to{};
  to.struct_size = sizeof to;
  to.status = static_cast<std::uint32_t>(from.status);
  to.determined = from.determined;
  to.points = from.points;
  to.fitted = from.fitted;
  to.rejected = from.rejected;
  to.revision = from.revision;
  to.memory_full = from.memory_full ? 1 : 0;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(to.rotation) = from.pose.rotation;
  std::ranges::copy(from.pose.translation, to.translation);
  const EulerAngles angles = euler_angles(from.pose.rotation);
  to.psi = angles.psi;
  to.theta = angles.theta;
  to.phi = angles.phi;
  // Symmetric: the order of rows and columns does not matter.
  std::ranges::copy(from.covariance.reshaped(), to.covariance);
  to.rms_mm = from.rms_mm;
  to.sigma_mm = from.sigma_mm;
  to.leading_edge = translate_region(from.leading_edge);
  to.rest = translate_region(from.rest);
  to.improving = from.improving ? 1 : 0;
  to.unproven = from.unproven;
  to.tolerance_factor_mm = from.mode_value_mm;
  to.smallest_tolerance_mm = from.smallest_tolerance_mm;
  to.stationarity = from.stationarity;
  to.loss_scale_mm = from.loss_scale_mm;
  to.certificate = translate_certificate(from.certificate);
  return to;
}

}  // namespace bladefit
