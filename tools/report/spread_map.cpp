#include "tools/report/spread_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/report/defect_table.hpp"
#include "tools/report/map_panel.hpp"
#include "tools/report/mark_legend.hpp"
#include "tools/report/picture_style.hpp"
#include "tools/report/report_text.hpp"

namespace bladefit {
namespace {

constexpr double kMapWidth = 720, kMapLeft = 44, kMapRight = 12, kMapTop = 22, kMapHeight = 265, kMapBottom = 38;
constexpr std::size_t kDefectsNamed = 16;

/// Where r/R and the share of the chord are drawn; two sides or, where they are not known, one.
struct Spread {
  double least, most;  ///< r/R
  bool two_sides;

  [[nodiscard]] double x(double chord) const {
    const double width = kMapWidth - kMapLeft - kMapRight;
    return two_sides ? kMapLeft + width * (chord + 1) / 2 : kMapLeft + width * chord;
  }
  [[nodiscard]] double y(double ratio) const { return kMapTop + kMapHeight * (most - ratio) / (most - least); }
  /// Negative on the pressure side.
  [[nodiscard]] double chord_of(const PlacedPoint& place) const {
    return two_sides && place.face == BladeSide::pressure ? -place.chord : place.chord;
  }
};

std::string map_word(double x, double y, std::string_view text, const char* style = "tick") {
  return fmt::format("<text class=\"{}\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", style, x, y,
                     text);
}

std::string grid_of(const Spread& spread) {
  std::string svg = fmt::format("<rect class=\"blade\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", kMapLeft,
                                kMapTop, kMapWidth - kMapLeft - kMapRight, kMapHeight);
  const double bottom = kMapTop + kMapHeight;
  for (int k = spread.two_sides ? -4 : 0; k <= 4; ++k) {
    const double x = spread.x(k / 4.0);
    svg += fmt::format("<path class=\"grid\" d=\"M{:.1f} {}V{}\"/>", x, kMapTop, bottom);
    svg += map_word(x, bottom + 13, k == 0 ? "LE" : fmt::format("{}", std::abs(k) * 25));
  }
  for (int k = static_cast<int>(std::ceil(spread.least * 10)); k <= spread.most * 10 + 1e-9; ++k) {
    const double y = spread.y(k / 10.0);
    svg += fmt::format("<path class=\"grid\" d=\"M{} {:.1f}H{}\"/>", kMapLeft, y, kMapWidth - kMapRight);
    svg += map_word(kMapLeft - 15, y + 4, fmt::format("{:.1f}", k / 10.0));
  }
  svg += fmt::format("<path class=\"frame\" d=\"M{:.1f} {}V{}\"/>", spread.x(0), kMapTop, bottom);
  svg += map_word(kMapLeft - 18, kMapTop - 7, "r/R", "axis");
  if (spread.two_sides) {
    svg += map_word(spread.x(-0.5), kMapTop - 7, "Pressure side", "axis");
    svg += map_word(spread.x(0.5), kMapTop - 7, "Suction side", "axis");
  }
  return svg +
         map_word(spread.x(0), bottom + 27,
                  "% of the chord from the leading edge (LE); on the suction side to the right") +
         "\n";
}

/// The numbers of the worst defects, each beside its worst point.
std::string defect_names(const Result& result, const Spread& spread) {
  const BladeDrawing& drawing = *result.drawing;
  std::string svg;
  for (std::size_t k = 0; k < std::min(drawing.defects.size(), kDefectsNamed); ++k) {
    const PlacedPoint& place = drawing.points[index_of_sequence(result, drawing.defects[k].sequence)];
    const double x = spread.x(spread.chord_of(place)), y = spread.y(place.radius / result.tip_radius);
    const bool right = x < kMapWidth - 60;
    svg += fmt::format("<text class=\"number\" text-anchor=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                       right ? "start" : "end", x + (right ? 8 : -8), y - 4, defect_name(k));
  }
  return svg;
}

std::string proof_marks(const Result& result, const Spread& spread) {
  std::string svg;
  for (std::uint32_t k = 0; k < result.certificate.count; ++k) {
    const std::size_t index = index_of_sequence(result, result.certificate.sequence.at(k));
    if (index >= result.points.size()) continue;
    const PlacedPoint& place = result.drawing->points[index];
    svg += fmt::format(
        "<path class=\"proof\" d=\"M{:.1f} {:.1f}l8 8l-8 8l-8 -8z\"><title>certificate: point {}</title>"
        "</path>\n",
        spread.x(spread.chord_of(place)), spread.y(place.radius / result.tip_radius) - 8,
        result.certificate.sequence.at(k));
  }
  return svg;
}

}  // namespace

std::string spread_map(const Result& result, const ToleranceScale& scale, const DrawnPoints& drawn) {
  if (!result.drawing || !result.drawing->edge_known || result.drawing->stations.empty() || !(result.tip_radius > 0))
    return "";
  const BladeDrawing& drawing = *result.drawing;
  const Spread spread{std::floor(drawing.root_radius / result.tip_radius * 20) / 20,
                      std::max(1.0, drawing.tip_radius / result.tip_radius), drawing.sides_known};
  std::string svg = grid_of(spread);
  for (const std::size_t index : drawn.indices) {
    const ResultPoint point = result.points[index];
    const PlacedPoint& place = drawing.points[index];
    if (std::isnan(place.chord)) continue;
    svg += point_mark(point.state, scale.share(point), spread.x(spread.chord_of(place)),
                      spread.y(place.radius / result.tip_radius), scale.colours()) +
           "\n";
  }
  svg += proof_marks(result, spread) + defect_names(result, spread);
  const double bottom = kMapTop + kMapHeight + kMapBottom;
  svg += tolerance_legend(result, scale, kMapLeft, bottom);
  return fmt::format(
      "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Map of the blade spread out from its leading edge\">\n{}{}"
      "</svg>\n",
      kMapWidth, bottom + kLegendRoom, kPictureStyle, svg);
}

}  // namespace bladefit
