#include "tools/report/tolerance_scale.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace bladefit {

ToleranceScale tolerance_scale_of(const Result& result) {
  ToleranceScale scale{0, false};
  for (const ResultPoint& point : result.points) {
    if (point.state == PointState::rejected) continue;
    scale.largest = std::max(scale.largest, std::abs(point.distance));
    if (std::isfinite(point.tolerance) && point.tolerance > 0) scale.in_tolerances = true;
  }
  constexpr double kSmallest = 1e-9;
  scale.largest = std::max(scale.largest, kSmallest);
  return scale;
}

DrawnPoints drawn_points_of(const Result& result, const ToleranceScale& scale) {
  std::vector<std::pair<double, std::size_t>> out, others;
  std::size_t index = 0;
  for (const ResultPoint& point : result.points)
    (point.state == PointState::out ? out : others).emplace_back(std::abs(scale.share(point)), index++);
  std::ranges::sort(out);
  DrawnPoints drawn;
  const std::size_t room = kMostDrawn - std::min(out.size(), kMostOutDrawn);
  const double step = std::max(1.0, static_cast<double>(others.size()) / static_cast<double>(room));
  std::vector<std::pair<double, std::size_t>> chosen;
  for (double at = 0; static_cast<std::size_t>(at) < others.size(); at += step)
    chosen.push_back(others[static_cast<std::size_t>(at)]);
  std::ranges::sort(chosen);
  for (const auto& [share, which] : chosen) drawn.indices.push_back(which);
  for (std::size_t k = out.size() - std::min(out.size(), kMostOutDrawn); k < out.size(); ++k)
    drawn.indices.push_back(out[k].second);
  drawn.left_out = result.points.size() - drawn.indices.size();
  return drawn;
}

std::string thinned_note(const Result& result, const DrawnPoints& drawn) {
  if (drawn.left_out == 0) return "";
  return fmt::format(
      "The pictures show {} of {} points: those out of tolerance, the {} worst of them at most, and evenly chosen "
      "others. "
      "The csv report has all.",
      drawn.indices.size(), result.points.size(), kMostOutDrawn);
}

}  // namespace bladefit
