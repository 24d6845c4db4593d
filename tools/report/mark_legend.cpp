#include "tools/report/mark_legend.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/report/map_panel.hpp"
#include "tools/report/report_text.hpp"

namespace bladefit {
namespace {

constexpr int kColours = 40, kMarkColumns = 3;
constexpr double kBarLength = 270, kBarThickness = 11;

std::string legend_text(double x, double y, std::string_view text, const char* anchor) {
  return fmt::format("<text class=\"tick\" text-anchor=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", anchor, x, y, text);
}

std::string share_bar(const Result& result, const ToleranceScale& scale, double x, double y) {
  const ColourScale colours = scale.colours();
  std::string svg;
  for (int k = 0; k < kColours; ++k) {
    const double share = (2.0 * k + 1.0) / kColours - 1.0;
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{}\" fill=\"{}\"/>",
                       x + k * kBarLength / kColours, y, kBarLength / kColours + 0.3, kBarThickness,
                       colours.colour(share));
  }
  svg += fmt::format("<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\"/>", x, y, kBarLength,
                     kBarThickness);
  for (const double share : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    svg += legend_text(x + kBarLength * (share + 1) / 2, y + kBarThickness + 12,
                       share == 0 ? "0" : fmt::format("{:+g}", share), "middle");
  }
  const std::string unit = scale.in_tolerances
                               ? "distance / tolerance"
                               : fmt::format("distance / largest ({})", LengthText(result).with_unit(scale.largest));
  svg += legend_text(x, y - 4, "- weld", "start") + legend_text(x + kBarLength, y - 4, "cut +", "end");
  return svg + legend_text(x + kBarLength / 2, y - 4, escaped(unit), "middle") + "\n";
}

bool occurs(const Result& result, PointState state) {
  return std::any_of(result.points.begin(), result.points.end(),
                     [state](const ResultPoint& point) { return point.state == state; });
}

}  // namespace

std::string tolerance_legend(const Result& result, const ToleranceScale& scale, double x, double y) {
  struct Entry {
    PointState state;
    double share;
    const char* meaning;
  };
  std::string svg = share_bar(result, scale, x, y + 14);
  int place = 0;
  for (const Entry& entry :
       {Entry{PointState::out, 1, "out: cut"}, Entry{PointState::out, -1, "out: weld"},
        Entry{PointState::in, 0.4, "in or not judged"}, Entry{PointState::undecided, 0, "undecided"},
        Entry{PointState::pending, 0, "not decided yet"}, Entry{PointState::rejected, 0, "does not count"}}) {
    if (!occurs(result, entry.state)) continue;
    const int column = place % kMarkColumns, row = place / kMarkColumns;
    const double left = x + kBarLength + 34 + 130 * column, top = y + 16 + 20 * row;
    svg += point_mark(entry.state, entry.share, left, top, scale.colours()) +
           legend_text(left + 11, top + 4, entry.meaning, "start") + "\n";
    ++place;
  }
  return svg;
}

}  // namespace bladefit
