#include "tools/results/left_out_lines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/results/optimum_lines.hpp"

namespace bladefit {
namespace {

/// "1 point is", "3 points are": with the verb for one and for several.
std::string points_that(std::size_t count, const char* one, const char* several) {
  return fmt::format("{} {}", count, count == 1 ? one : several);
}

/// Points that are out, but where the design has no surface.
std::string beyond_line(const Result& result) {
  std::size_t count = 0;
  double farthest = 0.0;
  for (const ResultPoint& point : result.points) {
    if (point.state != PointState::out || point.action != Action::none) continue;
    ++count;
    farthest = std::max(farthest, point.beyond);
  }
  if (count == 0) return "";
  return fmt::format(
      "{} up to {} beyond the edge of the design, where there is no surface to cut or weld to: check whether the blade "
      "is longer there, or was probed past the end of the design; then leave them out with --subset or --window\n",
      points_that(count, "point lies", "points lie"), length_text(result, farthest));
}

}  // namespace

std::string left_out_lines(const Result& result) {
  const auto left_out = [&result](LeftOut reason) {
    return static_cast<std::size_t>(
        std::count_if(result.points.begin(), result.points.end(), [reason](const ResultPoint& point) {
          return point.state == PointState::rejected && point.left_out == reason;
        }));
  };
  std::string text;
  if (const auto count = left_out(LeftOut::window); count > 0) {
    text += fmt::format("{} not judged: foot outside the window before the fit\n",
                        points_that(count, "point is", "points are"));
  }
  if (const auto count = left_out(LeftOut::edge); count > 0) {
    text += fmt::format(
        "{} not judged: foot on an outer edge of the design, and no farther beyond it than the "
        "tolerance\n",
        points_that(count, "point is", "points are"));
  }
  return text + beyond_line(result);
}

}  // namespace bladefit
