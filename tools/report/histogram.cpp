#include "tools/report/histogram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/report/findings.hpp"
#include "tools/report/picture_style.hpp"
#include "tools/report/report_text.hpp"

namespace bladefit {
namespace {

constexpr double kPlotWidth = 720, kPlotLeft = 56, kPlotRight = 16, kPlotTop = 26, kHeight = 130, kPlotBottom = 40;
constexpr double kWantedBins = 40;
constexpr double kLeastBar = 2;  // so that a single point among thousands is seen
constexpr double kFarAway = 4;   // times the distance that nine of ten points keep to, or the widest tolerance

/// The bins that all regions share: 2 * half bins of `step`, symmetric about 0.
struct Bins {
  double step = 1.0;
  int half = 1;

  [[nodiscard]] double limit() const { return step * half; }
  /// Bin of a distance; those beyond the limit are in the outermost bins.
  [[nodiscard]] std::size_t index(double distance) const {
    const double place = std::floor(distance / step) + half;
    return static_cast<std::size_t>(std::clamp(place, 0.0, 2.0 * half - 1.0));
  }
  [[nodiscard]] double x(double distance) const {
    return kPlotLeft + (distance + limit()) / (2 * limit()) * (kPlotWidth - kPlotLeft - kPlotRight);
  }
};

/// In the units of the result, as are all lengths here.
std::vector<double> distances_of(const Result& result, const Region* region) {
  std::vector<double> distances;
  for (const ResultPoint& point : result.points) {
    if (point.state != PointState::rejected && (region == nullptr || point.region == *region))
      distances.push_back(result.in_units(point.distance));
  }
  return distances;
}

/// A stray touch far from the blade must not squeeze all others into one bar.
Bins choose_bins(const Result& result) {
  std::vector<double> sizes = distances_of(result, nullptr);
  for (double& size : sizes) size = std::abs(size);
  std::sort(sizes.begin(), sizes.end());
  double wide = sizes[sizes.size() * 9 / 10];
  for (const double tolerance :
       {judged_tolerance(result, Region::leading_edge), judged_tolerance(result, Region::rest)}) {
    if (std::isfinite(tolerance)) wide = std::max(wide, result.in_units(tolerance));
  }
  const double range = std::max({std::min(sizes.back(), kFarAway * wide), 1e-9});
  const double step = round_step_above(2 * range / kWantedBins);
  return {step, static_cast<int>(std::ceil(range / step * (1.0 - 1e-12)))};
}

std::string tolerance_lines(const Bins& bins, double tolerance, double top) {
  std::string svg;
  if (!(tolerance <= bins.limit())) return svg;
  for (const double distance : {-tolerance, tolerance}) {
    svg += fmt::format("<path class=\"limit\" d=\"M{:.1f} {:.1f}v{}\"/>", bins.x(distance), top - 6, kHeight + 6);
    svg += fmt::format("<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{:+.4g}</text>\n",
                       bins.x(distance), top - 9, distance);
  }
  return svg;
}

std::string axis(const Bins& bins, double bottom, const std::string& title) {
  std::string svg =
      fmt::format("<path class=\"frame\" d=\"M{} {:.1f}H{}\"/>", kPlotLeft, bottom, kPlotWidth - kPlotRight);
  const double step = round_step_above(bins.limit() / 5);
  const int ticks = static_cast<int>(std::floor(bins.limit() / step * (1.0 + 1e-12)));
  for (int k = -ticks; k <= ticks; ++k) {
    const double x = bins.x(k * step);
    svg += fmt::format("<path class=\"frame\" d=\"M{:.1f} {:.1f}v4\"/>", x, bottom);
    svg += fmt::format("<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", x,
                       bottom + 16, k == 0 ? "0" : fmt::format("{:+.4g}", k * step));
  }
  return svg + fmt::format("<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                           bins.x(0), bottom + 31, title);
}

std::string bars(const Bins& bins, const std::vector<double>& distances, const ColourScale& scale, double bottom) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(2 * bins.half));
  for (const double distance : distances) ++counts.at(bins.index(distance));
  const auto most = static_cast<double>(*std::max_element(counts.begin(), counts.end()));
  std::string svg = fmt::format("<text class=\"tick\" text-anchor=\"end\" x=\"{}\" y=\"{:.1f}\">{}</text>",
                                kPlotLeft - 6, bottom - kHeight + 5, most);
  svg += fmt::format("<text class=\"tick\" text-anchor=\"end\" x=\"{}\" y=\"{:.1f}\">0</text>\n", kPlotLeft - 6,
                     bottom + 4);
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k] == 0) continue;
    const double from = bins.step * (static_cast<double>(k) - bins.half), middle = from + bins.step / 2;
    const double height = std::max(kLeastBar, kHeight * static_cast<double>(counts[k]) / most);
    svg += fmt::format(
        "<rect class=\"bar\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\">"
        "<title>{:+.4g} to {:+.4g}: {}</title></rect>\n",
        bins.x(from), bottom - height, bins.x(from + bins.step) - bins.x(from), height, scale.colour(middle), from,
        from + bins.step, counted(counts[k], "point"));
  }
  return svg;
}

}  // namespace

std::string distance_histogram(const Result& result, const ColourScale& scale) {
  if (distances_of(result, nullptr).empty()) return {};
  const Bins bins = choose_bins(result);
  std::string svg;
  double bottom = 0;
  for (const Region region : {Region::leading_edge, Region::rest}) {
    const std::vector<double> distances = distances_of(result, &region);
    if (distances.empty()) continue;
    const bool leading_edge = region == Region::leading_edge;
    const double top = bottom + kPlotTop;
    bottom = top + kHeight;
    svg += bars(bins, distances, scale, bottom);
    const double tolerance = judged_tolerance(result, region);
    svg += tolerance_lines(bins, result.in_units(tolerance), top);
    const auto beyond = std::count_if(distances.begin(), distances.end(),
                                      [&](double distance) { return std::abs(distance) > bins.limit(); });
    std::string title = leading_edge ? "leading edge" : "rest of the blade";
    title = fmt::format("{}: {} by distance, {}", title, counted(distances.size(), "point"), escaped(result.units));
    if (beyond > 0) title += fmt::format(" ({} farther away, counted in the outermost bars)", beyond);
    svg += axis(bins, bottom, title);
    bottom += kPlotBottom;
  }
  return fmt::format("<svg viewBox=\"0 0 {} {:.0f}\" role=\"img\" aria-label=\"Histogram of distances\">\n{}{}</svg>\n",
                     kPlotWidth, bottom, kPictureStyle, svg);
}

}  // namespace bladefit
