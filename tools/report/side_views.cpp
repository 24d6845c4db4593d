#include "tools/report/side_views.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tools/drawing/stations.hpp"
#include "tools/report/map_panel.hpp"
#include "tools/report/mark_legend.hpp"
#include "tools/report/picture_style.hpp"
#include "tools/report/side_field.hpp"

namespace bladefit {
namespace {

constexpr double kViewsWidth = 720, kViewMargin = 26, kViewGap = 12, kViewTop = 26, kMostHeight = 520;
constexpr int kOutlineSteps = 60, kArcSteps = 24, kTenths = 10;
constexpr double kBeyond = 0.03;  ///< of R, that circles go beyond the blade

/// A place in the plane across the shaft, seen from ahead or from astern, blade upwards [mm].
UnrolledPlace projected_place(double radius, double angle, double mirror) {
  return {mirror * radius * std::sin(angle), radius * std::cos(angle)};
}

struct Extent {
  UnrolledPlace least = UnrolledPlace::Constant(std::numeric_limits<double>::infinity());
  UnrolledPlace most = -least;
  void add(const UnrolledPlace& place) {
    least = least.cwiseMin(place);
    most = most.cwiseMax(place);
  }
};

/// A side on the paper: the same scale for both.
struct SideView {
  BladeSide side;
  double mirror, left, scale;
  Extent extent;

  [[nodiscard]] UnrolledPlace at(double radius, double angle) const {
    const UnrolledPlace place = projected_place(radius, angle, mirror);
    return {left + (place.x() - extent.least.x()) * scale, kViewTop + (extent.most.y() - place.y()) * scale};
  }
};

double angle_at(const BladeStation& station, double chord) {
  return station.leading_angle + chord * (station.trailing_angle - station.leading_angle);
}

std::string moves(const std::vector<UnrolledPlace>& places) {
  std::string path;
  for (const UnrolledPlace& place : places)
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", place.x(), place.y());
  return path;
}

std::string outline_of(const SideView& view, const BladeDrawing& drawing) {
  std::vector<UnrolledPlace> places;
  for (int k = 0; k <= 2 * kOutlineSteps + 1; ++k) {
    const bool leading = k <= kOutlineSteps;
    const double share = static_cast<double>(leading ? k : 2 * kOutlineSteps + 1 - k) / kOutlineSteps;
    const double radius = drawing.root_radius + share * (drawing.tip_radius - drawing.root_radius);
    const BladeStation station = station_at(drawing.stations, radius);
    places.push_back(view.at(radius, leading ? station.leading_angle : station.trailing_angle));
  }
  return fmt::format("<path class=\"frame\" d=\"{}Z\"/>\n", moves(places));
}

std::string field_of(const SideView& view, const Result& result, const ToleranceScale& scale) {
  const BladeDrawing& drawing = *result.drawing;
  const SideField field(result, scale, view.side);
  const auto corner = [&](int i, int j) {
    const double radius =
        drawing.root_radius + (drawing.tip_radius - drawing.root_radius) * i / static_cast<double>(SideField::kCells);
    return view.at(radius, angle_at(station_at(drawing.stations, radius), j / static_cast<double>(SideField::kCells)));
  };
  std::string svg;
  for (int i = 0; i < SideField::kCells; ++i) {
    for (int j = 0; j < SideField::kCells; ++j) {
      const std::optional<double> share = field.share(i, j);
      if (!share) continue;
      const std::string colour = scale.colours().colour(*share);
      svg += fmt::format("<path d=\"{0}Z\" fill=\"{1}\" stroke=\"{1}\" stroke-width=\"0.5\"/>\n",
                         moves({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)}), colour);
    }
  }
  return svg;
}

/// The angles between which the circle of a radius is drawn: somewhat beyond the blade there.
std::pair<double, double> circle_angles(const BladeDrawing& drawing, double radius) {
  const BladeStation station = station_at(drawing.stations, radius);
  const double beyond = kBeyond * drawing.tip_radius / radius;
  return {std::min(station.leading_angle, station.trailing_angle) - beyond,
          std::max(station.leading_angle, station.trailing_angle) + beyond};
}

/// Radii of the tenths of r/R that the blade has.
std::vector<double> circle_radii(const Result& result) {
  std::vector<double> radii;
  for (int k = 1; k <= kTenths; ++k) {
    const double radius = result.tip_radius * k / kTenths;
    if (radius >= result.drawing->root_radius && radius <= result.drawing->tip_radius * (1 + 1e-9))
      radii.push_back(radius);
  }
  return radii;
}

/// Circles of r/R about the shaft, with their names at the left end.
std::string circles_of(const SideView& view, const Result& result) {
  std::string svg;
  for (const double radius : circle_radii(result)) {
    const auto [least, most] = circle_angles(*result.drawing, radius);
    std::vector<UnrolledPlace> places;
    for (int i = 0; i <= kArcSteps; ++i)
      places.push_back(view.at(radius, least + (most - least) * i / static_cast<double>(kArcSteps)));
    const UnrolledPlace& end = view.mirror < 0 ? places.back() : places.front();
    svg += fmt::format(
        "<path class=\"grid\" d=\"{}\"/><text class=\"tick\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">"
        "{:.1f}</text>\n",
        moves(places), end.x() - 3, end.y() + 4, radius / result.tip_radius);
  }
  return svg;
}

std::string points_of(const SideView& view, const Result& result, const ToleranceScale& scale,
                      const DrawnPoints& drawn) {
  std::string svg;
  for (const std::size_t index : drawn.indices) {
    const PlacedPoint& place = result.drawing->points[index];
    if (place.face != view.side) continue;
    const ResultPoint point = result.points[index];
    const UnrolledPlace at = view.at(place.radius, place.angle);
    if (point.state == PointState::in) {
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"0.9\" fill=\"#444\"/>\n", at.x(), at.y());
    } else {
      svg += point_mark(point.state, scale.share(point), at.x(), at.y(), scale.colours()) + "\n";
    }
  }
  return svg;
}

/// All of the blade, its circles included.
Extent extent_of(const Result& result, double mirror) {
  Extent extent;
  for (const BladeStation& station : result.drawing->stations) {
    for (int k = 0; k <= 4; ++k) extent.add(projected_place(station.radius, angle_at(station, k / 4.0), mirror));
  }
  for (const double radius : circle_radii(result)) {
    const auto [least, most] = circle_angles(*result.drawing, radius);
    for (const double angle : {least, most}) extent.add(projected_place(radius, angle, mirror));
  }
  return extent;
}

}  // namespace

std::string side_views(const Result& result, const ToleranceScale& scale, const DrawnPoints& drawn) {
  if (!result.drawing || !result.drawing->sides_known) return "";
  const BladeDrawing& drawing = *result.drawing;
  // Seen against the axis' direction, its left is where the angle grows.
  const double from_suction = drawing.suction_ahead > 0 ? -1 : 1;
  const double room = (kViewsWidth - 2 * kViewMargin - kViewGap - 20) / 2;
  const Extent shape = extent_of(result, 1);
  const UnrolledPlace size = shape.most - shape.least;
  const double view_scale = std::min(room / size.x(), kMostHeight / size.y());
  const double height = size.y() * view_scale, spare = (room - size.x() * view_scale) / 2;
  std::string svg;
  for (const BladeSide side : {BladeSide::pressure, BladeSide::suction}) {
    const bool pressure = side == BladeSide::pressure;
    const double mirror = pressure ? -from_suction : from_suction;
    const double left = kViewMargin + (pressure ? 0 : room + kViewGap + 20) + spare;
    const SideView view{side, mirror, left, view_scale, extent_of(result, mirror)};
    svg += field_of(view, result, scale) + circles_of(view, result) + outline_of(view, drawing);
    svg += points_of(view, result, scale, drawn);
    svg += fmt::format("<text class=\"axis\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"14\">{}</text>\n",
                       left + size.x() * view_scale / 2,
                       pressure ? "Pressure side, seen from astern" : "Suction side, seen from ahead");
  }
  const double bottom = kViewTop + height + 14;
  svg += tolerance_legend(result, scale, kViewMargin, bottom);
  return fmt::format(
      "<svg viewBox=\"0 0 {} {:.0f}\" role=\"img\" aria-label=\"Pressure and suction side in projected "
      "outline\">\n{}{}</svg>\n",
      kViewsWidth, bottom + kLegendRoom, kPictureStyle, svg);
}

}  // namespace bladefit
