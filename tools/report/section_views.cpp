#include "tools/report/section_views.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tools/drawing/chord_place.hpp"
#include "tools/drawing/stations.hpp"
#include "tools/report/findings.hpp"
#include "tools/report/map_panel.hpp"
#include "tools/report/picture_style.hpp"
#include "tools/report/report_text.hpp"

namespace bladefit {
namespace {

constexpr double kViewWidth = 236, kViewHeight = 200, kInner = 38, kTitleRoom = 30, kScaleRoom = 24;
constexpr double kBand = 12;         ///< half width of the band that is aimed at [SVG units]
constexpr double kMostWhisker = 34;  ///< beyond it a whisker ends, with its distance in figures
constexpr double kShownWithoutZone = 0.08;
constexpr std::size_t kMostPointsShown = 120;

/// The chord's frame of a section: from the leading edge along the chord, and beside it, suction side upwards [mm].
struct SectionFrame {
  UnrolledPlace leading, along, beside;

  [[nodiscard]] UnrolledPlace of(const UnrolledPlace& place) const { return turned(place - leading); }
  [[nodiscard]] UnrolledPlace turned(const UnrolledPlace& way) const { return {way.dot(along), way.dot(beside)}; }
};

SectionFrame frame_of(const BladeStation& station, const BladeDrawing& drawing) {
  const UnrolledPlace along = chord_of(station).normalized();
  return {leading_edge_of(station), along, drawing.suction_beside * UnrolledPlace(-along.y(), along.x())};
}

/// A section's curve near its leading edge, in the frame of its chord, on the paper.
struct SectionView {
  std::vector<SectionPiece> pieces;
  UnrolledPlace least, most;
  double scale = 1;

  [[nodiscard]] UnrolledPlace at(const UnrolledPlace& place) const {
    const UnrolledPlace middle = (least + most) / 2;
    return {kViewWidth / 2 + (place.x() - middle.x()) * scale,
            kTitleRoom + (kViewHeight - kTitleRoom - kScaleRoom) / 2 - (place.y() - middle.y()) * scale};
  }
};

SectionView view_of(const MeasuredSection& section, const SectionFrame& frame, double chord) {
  SectionView view;
  const bool zone = std::ranges::any_of(section.pieces, &SectionPiece::leading_edge);
  view.least.setConstant(std::numeric_limits<double>::infinity());
  view.most = -view.least;
  for (const SectionPiece& piece : section.pieces) {
    const SectionPiece own{frame.of(piece.from), frame.of(piece.to), piece.leading_edge};
    if (zone ? !own.leading_edge : own.from.x() > kShownWithoutZone * chord) continue;
    view.pieces.push_back(own);
    for (const UnrolledPlace& end : {own.from, own.to}) {
      view.least = view.least.cwiseMin(end);
      view.most = view.most.cwiseMax(end);
    }
  }
  if (view.pieces.empty()) return view;
  const UnrolledPlace size = (view.most - view.least).cwiseMax(1e-9);
  view.scale =
      std::min((kViewWidth - 2 * kInner) / size.x(), (kViewHeight - kTitleRoom - kScaleRoom - 2 * kInner) / size.y());
  return view;
}

/// The place of the curve nearest to another; infinity away where the curve has none.
struct OnCurve {
  UnrolledPlace place = UnrolledPlace::Zero();
  double apart = std::numeric_limits<double>::infinity();
};

OnCurve nearest_on(const SectionView& view, const UnrolledPlace& place) {
  OnCurve nearest;
  for (const SectionPiece& piece : view.pieces) {
    const UnrolledPlace way = piece.to - piece.from;
    const double square = way.squaredNorm();
    const double t = square > 0 ? std::clamp((place - piece.from).dot(way) / square, 0.0, 1.0) : 0.0;
    const UnrolledPlace on = piece.from + t * way;
    const double apart = (on - place).norm();
    if (apart < nearest.apart) nearest = {on, apart};
  }
  return nearest;
}

std::string curve_path(const SectionView& view) {
  std::string path;
  for (const SectionPiece& piece : view.pieces) {
    const UnrolledPlace a = view.at(piece.from), b = view.at(piece.to);
    path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x(), a.y(), b.x(), b.y());
  }
  return path;
}

struct ShownPoint {
  std::size_t index;
  UnrolledPlace on_curve, normal;
  double share;  ///< of what is allowed, as an amount
};

/// Points of the section, in its frame: the foot of each goes to the same share of this section's chord.
std::vector<ShownPoint> shown_points(const Result& result, std::size_t section, const SectionView& view,
                                     const SectionFrame& frame, double chord, const ToleranceScale& scale) {
  const BladeDrawing& drawing = *result.drawing;
  std::vector<ShownPoint> shown;
  for (std::size_t index = 0; index < drawing.points.size(); ++index) {
    const PlacedPoint& place = drawing.points[index];
    if (place.section != section || !(place.radius > 0)) continue;
    const BladeStation own = station_at(drawing.stations, place.radius);
    const ChordPlace by_chord = on_chord(own, place.along, place.angle);
    const double ratio = chord / chord_of(own).norm();
    const UnrolledPlace foot(by_chord.along * chord, drawing.suction_beside * by_chord.beside * ratio);
    const OnCurve on = nearest_on(view, foot);
    if (on.apart >= 0.02 * chord) continue;
    shown.push_back({index, on.place, frame.turned(place.normal), std::abs(scale.share(result.points[index]))});
  }
  return shown;
}

std::string whisker(const Result& result, const SectionView& view, const ShownPoint& shown, double factor,
                    const ToleranceScale& scale) {
  const ResultPoint point = result.points[shown.index];
  const UnrolledPlace foot = view.at(shown.on_curve), normal(shown.normal.x(), -shown.normal.y());
  const double wanted = point.distance * factor * view.scale;
  const double length = std::clamp(wanted, -kMostWhisker, kMostWhisker);
  const UnrolledPlace end = foot + length * normal;
  std::string svg =
      fmt::format("<path class=\"whisker\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>", foot.x(), foot.y(), end.x(), end.y());
  svg += point_mark(point.state, scale.share(point), end.x(), end.y(), scale.colours());
  if (length != wanted) {
    svg += fmt::format("<text class=\"number\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>",
                       std::clamp(end.x(), 26.0, kViewWidth - 26), end.y() - 7,
                       LengthText(result).with_sign(point.distance));
  }
  return svg + "\n";
}

/// A bar as long as a round length, in true size and by the factor of the distances.
std::string scale_bars(const Result& result, double scale, double factor) {
  const double y = kViewHeight - 8;
  const auto bar = [&](double x, double per_unit, const char* suffix) {
    const double wanted = 50 / per_unit;
    const double length = round_step_above(wanted / 2.0001);
    return fmt::format(
        "<path class=\"frame\" d=\"M{:.1f} {:.1f}v-4m0 2h{:.1f}m0 -2v4\"/><text class=\"tick\" x=\"{:.1f}\" "
        "y=\"{:.1f}\">{:g} {}{}</text>",
        x, y, length * per_unit, x + length * per_unit + 4, y, length, escaped(result.units), suffix);
  };
  const double per_unit = scale * result.mm_per_unit;
  return bar(6, per_unit, "") + bar(kViewWidth / 2 + 4, per_unit * factor, " off");
}

std::string section_view(const Result& result, std::size_t index, const ToleranceScale& scale) {
  const BladeDrawing& drawing = *result.drawing;
  const MeasuredSection& section = drawing.sections[index];
  const BladeStation station =
      station_of(section.pieces, section.radius).value_or(station_at(drawing.stations, section.radius));
  const SectionFrame frame = frame_of(station, drawing);
  const double chord = chord_of(station).norm();
  const SectionView view = view_of(section, frame, chord);
  if (view.pieces.empty()) return "";
  std::vector<ShownPoint> shown = shown_points(result, index, view, frame, chord, scale);
  std::ranges::sort(shown, {}, &ShownPoint::share);
  const std::size_t hidden = shown.size() - std::min(shown.size(), kMostPointsShown);
  const double tolerance = judged_tolerance(result, Region::leading_edge);
  const bool judged = std::isfinite(tolerance) && tolerance > 0;
  const double unit = judged ? tolerance : scale.largest;
  const double factor = round_factor(kBand, unit, view.scale);
  const std::string curve = curve_path(view);
  std::string svg;
  if (judged) {
    svg +=
        fmt::format("<path class=\"band\" stroke-width=\"{:.2f}\" d=\"{}\"/>\n", 2 * unit * factor * view.scale, curve);
  }
  svg += fmt::format("<path class=\"curve\" d=\"{}\"/>\n", curve);
  for (std::size_t k = hidden; k < shown.size(); ++k) svg += whisker(result, view, shown[k], factor, scale);
  svg += fmt::format(
      "<text class=\"axis\" x=\"4\" y=\"12\">r/R {:.3f}</text><text class=\"tick\" text-anchor=\"end\" "
      "x=\"{}\" y=\"12\">{}, distances x {:g}</text>\n",
      section.radius / result.tip_radius, kViewWidth - 4,
      hidden > 0 ? fmt::format("{} worst of {} points", kMostPointsShown, shown.size())
                 : counted(shown.size(), "point"),
      factor);
  return svg + scale_bars(result, view.scale, factor);
}

}  // namespace

double round_factor(double wanted, double tolerance, double scale) {
  const double most = wanted / (tolerance * scale);
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= most) return step * power;
  }
  return power;
}

std::string section_views(const Result& result, const ToleranceScale& scale) {
  if (!result.drawing || !result.drawing->edge_known || result.drawing->stations.empty() || !(result.tip_radius > 0))
    return "";
  std::string html;
  std::string row;
  std::size_t in_row = 0;
  const auto end_row = [&] {
    if (in_row > 0) {
      html += fmt::format(
          "<svg viewBox=\"0 0 720 {}\" role=\"img\" aria-label=\"Leading edge at measured radii\">\n{}{}"
          "</svg>\n",
          kViewHeight + 6, kPictureStyle, row);
    }
    row.clear();
    in_row = 0;
  };
  for (std::size_t k = result.drawing->sections.size(); k-- > 0;) {
    const std::string view = section_view(result, k, scale);
    if (view.empty()) continue;
    row += fmt::format(
        "<svg x=\"{}\" y=\"0\" width=\"{}\" height=\"{}\"><rect class=\"grid\" x=\"0.5\" y=\"0.5\" "
        "width=\"{}\" height=\"{}\"/>{}</svg>\n",
        in_row * 241, kViewWidth, kViewHeight, kViewWidth - 1, kViewHeight - 1, view);
    if (++in_row == 3) end_row();
  }
  end_row();
  return html;
}

}  // namespace bladefit
