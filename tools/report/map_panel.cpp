#include "tools/report/map_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/report/findings.hpp"
#include "tools/report/report_text.hpp"
#include "tools/results/words.hpp"

namespace bladefit {
namespace {

constexpr double kPointRadius = 2.4, kOutRadius = 4.6, kGlyphArm = 2.6;
constexpr double kLetterWidth = 6.6, kLetterHeight = 12.0;
constexpr int kGridLines = 5;  // intervals of 0.2
constexpr std::size_t kMostLabels = 60;

struct Rectangle {
  double left, top, right, bottom;

  [[nodiscard]] bool meets(const Rectangle& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

Rectangle around(double x, double y, double radius) { return {x - radius, y - radius, x + radius, y + radius}; }

/// + or -, light on a dark colour and dark on a light one.
std::string glyph(bool plus, double x, double y, bool on_dark) {
  const char* const colour = on_dark ? "#fff" : "#000";
  std::string path = fmt::format("M{:.1f} {:.1f}h{:.1f}", x - kGlyphArm, y, 2 * kGlyphArm);
  if (plus) path += fmt::format("M{:.1f} {:.1f}v{:.1f}", x, y - kGlyphArm, 2 * kGlyphArm);
  return fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"1.7\"/>", path, colour);
}

std::string tooltip(const ResultPoint& point, const Result& result) {
  const LengthText text(result);
  return fmt::format("<title>point {}: {}, {}; tolerance {}; u {:.4f}, v {:.4f}</title>", point.sequence,
                     text.with_sign_and_unit(point.distance), word_of(point.action), text.with_unit(point.tolerance),
                     point.u, point.v);
}

std::vector<ResultPoint> drawn_points(const MapPanel& panel, const Result& result, const DrawnPoints& drawn) {
  std::vector<ResultPoint> points;
  for (const std::size_t index : drawn.indices) {
    const ResultPoint point = result.points[index];
    if (lies_in(point, panel.part)) points.push_back(point);
  }
  std::stable_sort(points.begin(), points.end(), [](const ResultPoint& a, const ResultPoint& b) {
    const bool a_out = a.state == PointState::out, b_out = b.state == PointState::out;
    if (a_out != b_out) return b_out;
    return std::abs(a.distance) < std::abs(b.distance);
  });
  return points;
}

/// Numbers of the worst points, each where it hides neither a mark nor another number.
std::string labels(const MapPanel& panel, const Result& result) {
  std::vector<ResultPoint> out;
  std::vector<Rectangle> taken;
  for (const ResultPoint& point : out_of_tolerance(result)) {
    if (!lies_in(point, panel.part)) continue;
    out.push_back(point);
    taken.push_back(around(panel.x(point.u), panel.y(point.v), kOutRadius));
  }
  if (out.size() > kMostLabels) return {};
  std::string svg;
  for (const ResultPoint& point : out) {
    const std::string number = fmt::format("{}", point.sequence);
    const double width = kLetterWidth * static_cast<double>(number.size()), gap = kOutRadius + 3.5;
    const double x = panel.x(point.u), y = panel.y(point.v);
    for (const auto& [left, middle] :
         {std::pair(x + gap, y), std::pair(x - gap - width, y), std::pair(x - width / 2, y - gap - kLetterHeight / 2),
          std::pair(x - width / 2, y + gap + kLetterHeight / 2)}) {
      const Rectangle place = {left, middle - kLetterHeight / 2, left + width, middle + kLetterHeight / 2};
      if (place.left < panel.left || place.right > panel.left + panel.width) continue;
      if (std::any_of(taken.begin(), taken.end(), [&](const Rectangle& other) { return place.meets(other); })) continue;
      taken.push_back(place);
      svg += fmt::format("<text class=\"number\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left, middle + 4, number);
      break;
    }
  }
  return svg;
}

std::string shaded_boxes(const MapPanel& panel, const std::vector<ParameterBox>& boxes) {
  std::string svg;
  for (const ParameterBox& box : boxes) {
    if (box.patch != panel.part.patch) continue;
    const double u_min = std::max(box.u_min, panel.part.u_min), u_max = std::min(box.u_max, panel.part.u_max);
    const double v_min = std::max(box.v_min, panel.part.v_min), v_max = std::min(box.v_max, panel.part.v_max);
    if (u_min > u_max || v_min > v_max) continue;
    svg += fmt::format(
        "<rect class=\"edge\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>leading-edge "
        "region</title></rect>\n",
        panel.x(u_min), panel.y(v_max), panel.x(u_max) - panel.x(u_min), panel.y(v_min) - panel.y(v_max));
  }
  return svg;
}

}  // namespace

bool lies_in(const ResultPoint& point, const ParameterBox& box) {
  return point.patch == box.patch && box.u_min <= point.u && point.u <= box.u_max && box.v_min <= point.v &&
         point.v <= box.v_max;
}

std::string panel_frame(const MapPanel& panel, const std::vector<ParameterBox>& boxes) {
  const double right = panel.left + panel.width, bottom = panel.top + panel.height;
  std::string svg =
      fmt::format("<rect class=\"blade\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", panel.left,
                  panel.top, panel.width, panel.height);
  svg += shaded_boxes(panel, boxes);
  for (int k = 0; k <= kGridLines; ++k) {
    const double share = static_cast<double>(k) / kGridLines;
    const double u = panel.part.u_min + share * (panel.part.u_max - panel.part.u_min), x = panel.x(u);
    const double v = panel.part.v_min + share * (panel.part.v_max - panel.part.v_min), y = panel.y(v);
    svg += fmt::format("<path class=\"grid\" d=\"M{:.1f} {:.1f}V{:.1f}M{:.1f} {:.1f}H{:.1f}\"/>", x, panel.top, bottom,
                       panel.left, y, right);
    svg += fmt::format("<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{:.4g}</text>", x,
                       bottom + 15, u);
    svg += fmt::format("<text class=\"tick\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{:.4g}</text>\n",
                       panel.left - 6, y + 4, v);
  }
  svg += fmt::format("<text class=\"axis\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">u</text>",
                     panel.left + panel.width / 2, bottom + 30);
  svg += fmt::format("<text class=\"axis\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">v</text>", panel.left - 34,
                     panel.top + panel.height / 2 + 4);
  svg +=
      fmt::format("<text class=\"axis\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", panel.left, panel.top - 7, panel.title);
  return svg;
}

std::string point_mark(PointState state, double distance, double x, double y, const ColourScale& scale) {
  if (state == PointState::rejected) {
    return fmt::format("<path class=\"rejected\" d=\"M{:.1f} {:.1f}l5 5m0 -5l-5 5\"/>", x - 2.5, y - 2.5);
  }
  if (state == PointState::pending) {
    return fmt::format("<circle class=\"pending\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>", x, y, kPointRadius);
  }
  if (state == PointState::undecided) {
    return fmt::format("<rect class=\"undecided\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"6\" height=\"6\"/>", x - 3, y - 3);
  }
  if (state == PointState::in) {
    return fmt::format("<circle class=\"in\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>", x, y, kPointRadius,
                       scale.colour(distance));
  }
  return fmt::format("<circle class=\"out\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>", x, y, kOutRadius,
                     scale.colour(distance)) +
         glyph(distance > 0, x, y, scale.is_dark(distance));
}

std::string panel_points(const MapPanel& panel, const Result& result, const ColourScale& scale,
                         const DrawnPoints& drawn) {
  std::string svg;
  for (const ResultPoint& point : drawn_points(panel, result, drawn)) {
    const std::string mark =
        point_mark(point.state, result.in_units(point.distance), panel.x(point.u), panel.y(point.v), scale);
    svg += point.state == PointState::out ? fmt::format("<g>{}{}</g>\n", tooltip(point, result), mark) : mark + "\n";
  }
  return svg + labels(panel, result);
}

}  // namespace bladefit
