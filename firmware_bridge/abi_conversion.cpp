#include "firmware_bridge/abi_conversion.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace bladefit {
namespace {

constexpr double kOrthogonal = 1e-9;
constexpr std::uint32_t kLeastCapacity = 6, kLeastRefresh = 2, kMostRefresh = 64;

Mat3 rotation_from(const double (&rows)[9]) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows);
}

bool is_not_number(double value) { return std::isnan(value); }

bool all_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

bool numbers_are_finite(const bladefit_config& config) {
  const double single[] = {config.probe_radius_mm, config.noise_floor_mm, config.determined_mm, config.transition,
                           config.window_low,      config.window_high,    config.ratio,         config.loss_scale_mm};
  const auto boxes = std::span(config.boxes).first(config.box_count);
  return all_finite(single) && all_finite(config.start_rotation) && all_finite(config.start_translation) &&
         !is_not_number(config.leading_edge_tolerance_mm) && !is_not_number(config.rest_tolerance_mm) &&
         std::ranges::all_of(boxes, [](const bladefit_box& box) {
           const double limits[] = {box.u_min, box.u_max, box.v_min, box.v_max};
           return all_finite(limits);
         });
}

bool choices_are_in_range(const bladefit_config& config) {
  return config.capacity >= kLeastCapacity && config.capacity <= BLADEFIT_MAX_CAPACITY &&
         config.refresh_per_push >= kLeastRefresh && config.refresh_per_push <= kMostRefresh &&
         config.use_approach <= 1 && config.edges <= BLADEFIT_EDGES_USE && config.box_count <= BLADEFIT_MAX_BOXES &&
         config.mode <= BLADEFIT_CONSTRAINED && config.regions <= BLADEFIT_REGIONS_FIXED && config.locked < kLockAll &&
         config.loss <= BLADEFIT_LOSS_TUKEY;
}

bool lengths_are_in_range(const bladefit_config& config) {
  return config.probe_radius_mm >= 0 && config.noise_floor_mm > 0 && config.determined_mm >= 0 &&
         config.leading_edge_tolerance_mm > 0 && config.rest_tolerance_mm > 0 && config.transition >= 0 &&
         config.window_low >= 0 && config.window_low < config.window_high && config.window_high <= 1 &&
         (config.ratio == 0 || config.ratio >= 1) && config.loss_scale_mm >= 0 &&
         (config.mode != BLADEFIT_CONSTRAINED || std::isfinite(config.rest_tolerance_mm)) &&
         (config.loss == BLADEFIT_LOSS_NONE || config.mode == BLADEFIT_LEAST_SQUARES);
}

bool boxes_are_in_range(const bladefit_config& config) {
  return std::ranges::all_of(std::span(config.boxes).first(config.box_count),
                             [](const bladefit_box& box) { return box.u_min <= box.u_max && box.v_min <= box.v_max; });
}

bool is_rotation(const Mat3& matrix) {
  const Mat3 deviation = matrix.transpose() * matrix - Mat3::Identity();
  return deviation.cwiseAbs().maxCoeff() < kOrthogonal && matrix.determinant() > 0;
}

ToleranceMap tolerance_from(const bladefit_config& config) {
  ToleranceMap map;
  map.box_count = config.box_count;
  std::ranges::transform(std::span(config.boxes).first(config.box_count), map.boxes.begin(),
                         [](const bladefit_box& box) {
                           return ParameterBox{box.patch, box.u_min, box.u_max, box.v_min, box.v_max};
                         });
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

}  // namespace

bladefit_status translate_config(const bladefit_config& from, LocalizerConfig& to) {
  if (!choices_are_in_range(from)) return BLADEFIT_OUT_OF_RANGE;
  if (!numbers_are_finite(from)) return BLADEFIT_NOT_FINITE;
  if (!lengths_are_in_range(from) || !boxes_are_in_range(from)) return BLADEFIT_OUT_OF_RANGE;
  const Mat3 rotation = rotation_from(from.start_rotation);
  if (!is_rotation(rotation)) return BLADEFIT_OUT_OF_RANGE;
  to.capacity = from.capacity;
  to.refresh_per_push = from.refresh_per_push;
  to.probe_radius_mm = from.probe_radius_mm;
  to.use_approach = from.use_approach == 1;
  to.edges = static_cast<EdgePolicy>(from.edges);
  to.noise_floor_mm = from.noise_floor_mm;
  to.determined_mm = from.determined_mm;
  to.window_low = from.window_low;
  to.window_high = from.window_high;
  to.start = {rotation, Eigen::Map<const Vec3>(from.start_translation)};
  to.tolerance = tolerance_from(from);
  to.mode = static_cast<FitMode>(from.mode);
  to.regions = static_cast<RegionPolicy>(from.regions);
  to.locked = static_cast<std::uint8_t>(from.locked);
  to.loss = static_cast<Loss>(from.loss);
  to.loss_scale_mm = from.loss_scale_mm;
  to.ratio = from.ratio == 0 ? 10.0 : from.ratio;
  return BLADEFIT_OK;
}

bladefit_status translate_point(const bladefit_point& from, ProbePoint& to) {
  if (from.path > std::numeric_limits<std::uint16_t>::max()) return BLADEFIT_OUT_OF_RANGE;
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
  to.tolerance_factor_mm = from.tolerance_factor_mm;
  to.smallest_tolerance_mm = from.smallest_tolerance_mm;
  to.stationarity = from.stationarity;
  to.loss_scale_mm = from.loss_scale_mm;
  to.certificate = translate_certificate(from.certificate);
  return to;
}

}  // namespace bladefit
