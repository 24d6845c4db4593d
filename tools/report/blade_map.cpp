#include "tools/report/blade_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "tools/report/map_panel.hpp"
#include "tools/report/picture_style.hpp"
#include "tools/report/report_text.hpp"

namespace bladefit {
namespace {

constexpr double kWidth = 720, kLeft = 46, kTop = 24, kBottom = 36, kGap = 60, kRight = 14;
constexpr double kOneHeight = 330, kSmallHeight = 230, kLegendHeight = 92;
constexpr std::size_t kMostColumns = 3;

std::set<std::uint32_t> patches_of(const Result& result) {
  std::set<std::uint32_t> patches;
  for (const ResultPoint& point : result.points) patches.insert(point.patch);
  return patches;
}

std::vector<MapPanel> place_panels(const std::set<std::uint32_t>& patches) {
  const std::size_t columns = std::clamp<std::size_t>(patches.size(), 1, kMostColumns);
  const auto gaps = static_cast<double>(columns - 1);
  const double width = (kWidth - kLeft - kRight - gaps * kGap) / static_cast<double>(columns);
  const double height = columns == 1 ? kOneHeight : kSmallHeight;
  std::vector<MapPanel> panels;
  for (const std::uint32_t patch : patches) {
    const std::size_t column = panels.size() % columns, row = panels.size() / columns;
    const double left = kLeft + static_cast<double>(column) * (width + kGap);
    const double top = kTop + static_cast<double>(row) * (kTop + height + kBottom);
    panels.push_back({fmt::format("Patch {}", patch), {.patch = patch}, left, top, width, height});
  }
  return panels;
}

/// The leading-edge boxes that hold a point out of tolerance and are a part of their patch only.
std::vector<MapPanel> place_magnified(const Result& result) {
  std::vector<MapPanel> panels;
  for (const ParameterBox& box : result.boxes) {
    const double u_range = box.u_max - box.u_min, v_range = box.v_max - box.v_min;
    const bool any_out = std::any_of(result.points.begin(), result.points.end(), [&box](const ResultPoint& point) {
      return point.state == PointState::out && lies_in(point, box);
    });
    if (!any_out || u_range <= 0 || v_range <= 0 || u_range * v_range >= 1) continue;
    const double top = kTop + static_cast<double>(panels.size()) * (kTop + kOneHeight + kBottom);
    panels.push_back({fmt::format("Patch {}", box.patch), box, kLeft, top, kWidth - kLeft - kRight, kOneHeight});
  }
  return panels;
}

double bottom_of(const std::vector<MapPanel>& panels) {
  return panels.empty() ? 0.0 : panels.back().top + panels.back().height + kBottom;
}

std::string opening(double height, const char* label) {
  return fmt::format("<svg viewBox=\"0 0 {} {:.0f}\" role=\"img\" aria-label=\"{}\">\n{}", kWidth, height, label,
                     kPictureStyle);
}

std::string drawn_panels(const std::vector<MapPanel>& panels, const Result& result, const ColourScale& scale,
                         const DrawnPoints& drawn) {
  std::string svg;
  for (const MapPanel& panel : panels) svg += panel_frame(panel, result.boxes);
  for (const MapPanel& panel : panels) svg += panel_points(panel, result, scale, drawn);
  return svg;
}

std::string caption(double x, double y, const std::string& text, const char* anchor = "start") {
  return fmt::format("<text class=\"tick\" text-anchor=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", anchor, x, y, text);
}

/// A bar of the colours with the distances they mean.
std::string colour_bar(double x, double y, const ColourScale& scale, const std::string& units) {
  constexpr int kCells = 40;
  constexpr double kBarWidth = 290, kBarHeight = 14;
  std::string svg;
  for (int k = 0; k < kCells; ++k) {
    const double distance = scale.limit * ((2.0 * k + 1.0) / kCells - 1.0);
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\" fill=\"{}\"/>",
                       x + k * kBarWidth / kCells, y, kBarWidth / kCells + 0.3, kBarHeight, scale.colour(distance));
  }
  svg += fmt::format("<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\"/>\n", x, y, kBarWidth,
                     kBarHeight);
  for (int k = -2; k <= 2; ++k) {
    const double distance = scale.limit * k / 2.0;
    svg += caption(x + kBarWidth * (k + 2) / 4.0, y + 28, k == 0 ? "0" : fmt::format("{:+.4g}", distance), "middle");
  }
  svg += caption(x, y - 6, "too little material");
  svg += caption(x + kBarWidth / 2, y - 6, "distance, " + units, "middle");
  return svg + caption(x + kBarWidth, y - 6, "too much material", "end") + "\n";
}

bool has_state(const Result& result, PointState state) {
  return std::any_of(result.points.begin(), result.points.end(),
                     [state](const ResultPoint& point) { return point.state == state; });
}

/// The marks that occur, each with its meaning.
std::string mark_legend(double x, double y, const Result& result, const ColourScale& scale) {
  struct Entry {
    PointState state;
    double distance;
    const char* meaning;
  };
  const double full = scale.limit;
  std::string svg;
  std::size_t place = 0;
  for (const Entry& entry :
       {Entry{PointState::out, full, "out: cut"}, Entry{PointState::out, -full, "out: weld"},
        Entry{PointState::in, 0.4 * full, "in tolerance or not judged"}, Entry{PointState::undecided, 0, "undecided"},
        Entry{PointState::pending, 0, "not decided yet"}, Entry{PointState::rejected, 0, "does not count"}}) {
    if (!has_state(result, entry.state)) continue;
    const std::size_t column = place % 2, row = place / 2;
    const double left = x + 175.0 * static_cast<double>(column), top = y + 20.0 * static_cast<double>(row);
    svg +=
        point_mark(entry.state, entry.distance, left, top, scale) + caption(left + 12, top + 4, entry.meaning) + "\n";
    ++place;
  }
  return svg;
}

}  // namespace

std::string blade_map(const Result& result, const ColourScale& scale, const DrawnPoints& drawn) {
  const std::vector<MapPanel> panels = place_panels(patches_of(result));
  const double bottom = bottom_of(panels);
  std::string svg = opening(bottom + kLegendHeight + 20, "Map of the unrolled blade: distance of every point") +
                    drawn_panels(panels, result, scale, drawn);
  svg += colour_bar(kLeft, bottom + 24, scale, escaped(result.units));
  svg += mark_legend(kLeft + 330, bottom + 22, result, scale);
  if (!result.boxes.empty()) {
    svg += fmt::format("<rect class=\"edge\" x=\"{}\" y=\"{:.1f}\" width=\"22\" height=\"14\"/>", kLeft, bottom + 62);
    svg += caption(kLeft + 30, bottom + 73, "leading-edge region");
  }
  return svg + "</svg>\n";
}

std::string leading_edge_map(const Result& result, const ColourScale& scale, const DrawnPoints& drawn) {
  const std::vector<MapPanel> panels = place_magnified(result);
  if (panels.empty()) return {};
  return opening(bottom_of(panels), "Leading edge, magnified") + drawn_panels(panels, result, scale, drawn) +
         "</svg>\n";
}

}  // namespace bladefit
