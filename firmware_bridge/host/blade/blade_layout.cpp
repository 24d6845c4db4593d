#include "firmware_bridge/host/blade/blade_layout.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/surface/trim.hpp"

namespace bladefit {
namespace {

constexpr double kPlaces = 3000;  ///< about, of all patches, and again of the leading edge
constexpr std::uint32_t kFewestSteps = 6, kMostSteps = 48;

/// The chord must lie along the axis by this share at least, or nothing tells which way the blade goes.
constexpr double kLeastAdvance = 0.08;
/// Cosines to the normal of the suction side, below which a place of the leading edge is of the nose, and any other
/// one of neither side.
constexpr double kNoseCosine = 0.5, kSideCosine = 0.1;

/// Along each side of so many pieces.
std::uint32_t steps_for(std::size_t pieces) {
  const double steps = std::sqrt(kPlaces / static_cast<double>(std::max<std::size_t>(pieces, 1)));
  return std::clamp(static_cast<std::uint32_t>(steps), kFewestSteps, kMostSteps);
}

/// A vector without its part along a unit vector.
Vec3 without(const Vec3& vector, const Vec3& along) { return vector - vector.dot(along) * along; }

Vec3 unit_or_zero(const Vec3& vector) {
  const double length = vector.norm();
  return length > 0 ? Vec3(vector / length) : Vec3::Zero();
}

/// Sums of places, of which the mean is wanted.
struct Mean {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  void add(const Vec3& place) {
    sum += place;
    count += 1;
  }
  [[nodiscard]] Vec3 value() const { return sum / count; }
};

}  // namespace

BladeLayout::BladeLayout(const DesignImage& design, const LocalizerConfig& config, const ShaftAxis& axis,
                         double tip_radius_mm)
    : axis_(axis) {
  const Surface surface(design);
  scale_mm_ = surface.half_diagonal();
  middle_ = surface.middle();
  const ToleranceMap& map = config.tolerance;
  for (std::uint32_t k = 0; k < map.box_count; ++k)
    take_places(surface, config, map.boxes[k], steps_for(map.box_count));
  const std::size_t patches = design.patches().size();
  for (std::uint32_t patch = 0; patch < patches; ++patch) {
    take_places(surface, config, {.patch = patch}, steps_for(patches));
  }
  double least = 0, most = 0, tip = 0;
  for (const BladePlace& place : places_) {
    tip = std::max(tip, place.radius);
    if (place.region != Region::leading_edge) continue;
    least = least > 0 ? std::min(least, place.radius) : place.radius;
    most = std::max(most, place.radius);
  }
  tip_mm_ = tip_radius_mm > 0 ? tip_radius_mm : tip;
  root_mm_ = least;
  edge_tip_mm_ = most;
  find_sides();
  for (BladePlace& place : places_) place.side = side_of(place.point, place.normal, place.region);
}

void BladeLayout::take_places(const Surface& surface, const LocalizerConfig& config, const ParameterBox& box,
                              std::uint32_t steps) {
  const auto between = [steps](double low, double high, std::uint32_t k) {
    return low + (high - low) * static_cast<double>(k) / static_cast<double>(steps);
  };
  const auto used = [&config](double t) { return t >= config.window_low && t <= config.window_high; };
  for (std::uint32_t i = 0; i <= steps; ++i) {
    for (std::uint32_t j = 0; j <= steps; ++j) {
      const double u = between(box.u_min, box.u_max, i), v = between(box.v_min, box.v_max, j);
      const SurfacePlace at = surface.place_at(box.patch, u, v);
      if (!used(u) || !used(v) || !inside_face(surface.image(), at)) continue;
      const SurfacePoint point = surface.evaluate(at);
      places_.push_back({.point = point.s,
                         .normal = surface.normal(at, point),
                         .radius = axis_.radius_of(point.s),
                         .region = part_at(config.tolerance, box.patch, u, v, point.s).region});
    }
  }
}

/// At each radius the chord runs from the middle of the section to the leading edge. With positive pitch the leading
/// edge lies ahead, and the suction side looks ahead, square to the chord.
void BladeLayout::find_sides() {
  suction_.fill(Vec3::Zero());
  if (!(edge_tip_mm_ > root_mm_)) return;
  std::array<Mean, kStations> edge, body;
  for (const BladePlace& place : places_) {
    (place.region == Region::leading_edge ? edge : body)[station_of(place.radius)].add(place.point);
  }
  std::array<Vec3, kStations> chord;
  Mean advance;
  for (std::size_t k = 0; k < kStations; ++k) {
    chord[k] = Vec3::Zero();
    if (edge[k].count == 0 || body[k].count == 0) continue;
    const Vec3 arm = edge[k].value() - axis_.point;
    const Vec3 outward = unit_or_zero(without(arm, axis_.direction));
    chord[k] = unit_or_zero(without(edge[k].value() - body[k].value(), outward));
    advance.add(chord[k]);
  }
  if (advance.count == 0) return;
  const double along = advance.value().dot(axis_.direction);
  if (std::abs(along) < kLeastAdvance) return;
  const Vec3 ahead = along > 0 ? axis_.direction : Vec3(-axis_.direction);
  for (std::size_t k = 0; k < kStations; ++k) {
    if (!chord[k].isZero()) suction_[k] = unit_or_zero(without(ahead, chord[k]));
  }
}

std::size_t BladeLayout::station_of(double radius_mm) const {
  const double share = (radius_mm - root_mm_) / (edge_tip_mm_ - root_mm_);
  const double station = std::clamp(share * kStations, 0.0, static_cast<double>(kStations - 1));
  return static_cast<std::size_t>(station);
}

std::size_t BladeLayout::cell_of(double radius_mm) const {
  if (!(edge_tip_mm_ > root_mm_)) return 0;
  const double share = (radius_mm - root_mm_) / (edge_tip_mm_ - root_mm_);
  constexpr double kCells = BladeView::kCells;
  return static_cast<std::size_t>(std::clamp(share * kCells, 0.0, kCells - 1));
}

double BladeLayout::radius_of_cell(std::size_t cell) const {
  constexpr double kHalf = 0.5;
  const double share = (static_cast<double>(cell) + kHalf) / static_cast<double>(BladeView::kCells);
  return root_mm_ + share * (edge_tip_mm_ - root_mm_);
}

std::size_t BladeLayout::band_of(double radius_mm) const {
  constexpr double kBands = BladeView::kBands;
  return static_cast<std::size_t>(std::clamp(ratio_of(radius_mm) * kBands, 0.0, kBands - 1));
}

BladeSide BladeLayout::side_of(const Vec3& point, const Vec3& normal, Region region) const {
  if (!(edge_tip_mm_ > root_mm_)) return BladeSide::unknown;
  const Vec3& suction = suction_[station_of(axis_.radius_of(point))];
  if (suction.isZero()) return BladeSide::unknown;
  const double cosine = normal.dot(suction);
  const bool edge = region == Region::leading_edge;
  if (std::abs(cosine) < (edge ? kNoseCosine : kSideCosine)) return edge ? BladeSide::nose : BladeSide::unknown;
  return cosine > 0 ? BladeSide::suction : BladeSide::pressure;
}

}  // namespace bladefit
