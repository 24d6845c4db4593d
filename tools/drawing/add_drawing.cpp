#include "tools/drawing/add_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "firmware_bridge/host/blade/blade_layout.hpp"
#include "firmware_bridge/host/blade/defects.hpp"
#include "tools/drawing/chord_place.hpp"
#include "tools/drawing/measured_radii.hpp"
#include "tools/drawing/stations.hpp"

namespace bladefit {
namespace {

/// What lies between the feet of points and the drawing.
struct DrawingParts {
  const Surface& surface;
  const ShaftFrame& frame;
  const BladeLayout& layout;
  double suction_sign = 0;  ///< of the side of the chord that is the suction side's; 0 = not known
};

LocalizerConfig config_of(const Result& result) {
  LocalizerConfig config;
  ToleranceMap& map = config.tolerance;
  for (const ParameterBox& box : result.boxes) {
    if (map.box_count < ToleranceMap::kMaxBoxes) map.boxes[map.box_count++] = box;
  }
  return config;
}

/// On which side of the chord places of the suction side lie, by most of them.
double suction_sign_of(const DrawingParts& parts, const std::vector<BladeStation>& stations) {
  double votes = 0;
  for (const BladePlace& place : parts.layout.places()) {
    if (place.side != BladeSide::suction && place.side != BladeSide::pressure) continue;
    const double beside = on_chord(station_at(stations, place.radius), parts.frame.along_of(place.point),
                                   parts.frame.angle_of(place.point))
                              .beside;
    votes += (beside > 0) == (place.side == BladeSide::suction) ? 1 : -1;
  }
  return votes > 0 ? 1 : votes < 0 ? -1 : 0;
}

/// Whether the suction side looks along the axis or against it.
double suction_ahead_of(const BladeLayout& layout) {
  double sum = 0;
  for (const BladePlace& place : layout.places()) {
    const double along = place.normal.dot(layout.axis().direction);
    if (place.side == BladeSide::suction) sum += along;
    if (place.side == BladeSide::pressure) sum -= along;
  }
  return sum < 0 ? -1 : 1;
}

PlacedPoint placed(const DrawingParts& parts, const BladeDrawing& drawing, const ResultPoint& point, Foot& foot) {
  const SurfacePlace place = parts.surface.place_at(point.patch, point.u, point.v);
  const SurfacePoint at = parts.surface.evaluate(place);
  foot.point = at.s;
  foot.normal = parts.surface.normal(place, at);
  PlacedPoint out{
      .radius = parts.frame.radius_of(at.s), .along = parts.frame.along_of(at.s), .angle = parts.frame.angle_of(at.s)};
  const UnrolledPlace normal = parts.frame.unrolled_direction(at.s, foot.normal);
  if (normal.norm() > 0) out.normal = normal.normalized();
  out.side = parts.layout.side_of(at.s, foot.normal, point.region);
  out.face = out.side;
  if (!drawing.edge_known || drawing.stations.empty()) return out;
  const ChordPlace chord = on_chord(station_at(drawing.stations, out.radius), out.along, out.angle);
  out.chord = std::clamp(chord.along, 0.0, 1.0);
  const bool one_side = out.side == BladeSide::suction || out.side == BladeSide::pressure;
  if (!one_side && parts.suction_sign != 0)
    out.face = chord.beside * parts.suction_sign > 0 ? BladeSide::suction : BladeSide::pressure;
  return out;
}

Verdict verdict_of(const ResultPoint& point, const Foot& foot) {
  Verdict verdict;
  verdict.sequence = point.sequence;
  verdict.foot = foot;
  verdict.foot.patch = point.patch;
  verdict.foot.distance = point.distance;
  verdict.region = point.region;
  verdict.tolerance_mm = point.tolerance;
  verdict.state = point.state;
  verdict.action = point.action;
  return verdict;
}

void place_points(const DrawingParts& parts, const Result& result, BladeDrawing& drawing) {
  std::map<std::uint32_t, Verdict> out;
  for (const ResultPoint& point : result.points) {
    if (point.patch >= parts.surface.image().patches().size()) {
      drawing.points.emplace_back();
      continue;
    }
    Foot foot;
    drawing.points.push_back(placed(parts, drawing, point, foot));
    if (point.state == PointState::out) out.emplace(point.sequence, verdict_of(point, foot));
  }
  drawing.defects = joined_defects(parts.layout, out, result.pose);
  if (out.size() > kMostJoined) drawing.out_not_joined = static_cast<std::uint32_t>(out.size() - kMostJoined);
}

void add_sections(const RadiusGrid& grid, const Result& result, double tip_radius, BladeDrawing& drawing) {
  std::vector<double> radii;
  std::size_t index = 0;
  for (const ResultPoint& point : result.points) {
    const PlacedPoint& place = drawing.points[index++];
    if (point.state != PointState::rejected && place.radius > 0) radii.push_back(place.radius);
  }
  const std::vector<double> measured = measured_radii(std::move(radii), tip_radius);
  for (const double radius : measured) drawing.sections.push_back({radius, grid.cut(radius)});
  if (measured.empty()) return;
  for (PlacedPoint& place : drawing.points) {
    const auto nearest =
        std::ranges::min_element(measured, {}, [&place](double radius) { return std::abs(radius - place.radius); });
    place.section = static_cast<std::uint16_t>(nearest - measured.begin());
  }
}

}  // namespace

void add_drawing(const DesignImage& design, Result& result) {
  const Surface surface(design);
  const BladeLayout layout(design, config_of(result), result.axis, result.tip_radius);
  const ShaftFrame frame(result.axis, surface.middle());
  const RadiusGrid grid(surface, frame, result.boxes);
  BladeDrawing drawing;
  drawing.root_radius = grid.least_radius();
  drawing.tip_radius = grid.greatest_radius();
  drawing.edge_known = !result.boxes.empty();
  drawing.stations = stations_of(grid);
  DrawingParts parts{surface, frame, layout};
  if (drawing.edge_known && !drawing.stations.empty()) parts.suction_sign = suction_sign_of(parts, drawing.stations);
  drawing.sides_known = parts.suction_sign != 0;
  drawing.suction_ahead = suction_ahead_of(layout);
  if (drawing.sides_known) drawing.suction_beside = parts.suction_sign;
  place_points(parts, result, drawing);
  add_sections(grid, result, layout.tip_radius_mm(), drawing);
  result.points.change_each([&surface](ResultPoint point) {
    if (!point.foot && point.patch < surface.image().patches().size())
      point.foot = surface.evaluate(surface.place_at(point.patch, point.u, point.v)).s;
    return point;
  });
  result.drawing = std::move(drawing);
}

}  // namespace bladefit
