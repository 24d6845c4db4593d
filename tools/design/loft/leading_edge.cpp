#include "tools/design/loft/leading_edge.hpp"

#include <algorithm>

#include "tools/design/loft/spline_fit.hpp"

namespace bladefit {
namespace {

/// The largest gap between the ends of a section that is closed, as a share of its chord.
constexpr double kLargestGap = 0.2;

/// v of one section, and nothing where it is open.
std::optional<double> leading_edge_of(const BladeSection& section) {
  const Eigen::Vector3d trailing_edge = 0.5 * (section.points.front() + section.points.back());
  const auto farthest = std::ranges::max_element(
      section.points, {}, [&](const Eigen::Vector3d& point) { return (point - trailing_edge).squaredNorm(); });
  const double chord = (*farthest - trailing_edge).norm();
  const double gap = (section.points.front() - section.points.back()).norm();
  if (!(gap <= kLargestGap * chord)) return std::nullopt;
  std::vector<ExtendedPoint> points;
  for (const Eigen::Vector3d& point : section.points) points.emplace_back(point.cast<long double>());
  const auto parameters = chord_parameters(points);
  if (!parameters) return std::nullopt;
  return static_cast<double>((*parameters)[static_cast<std::size_t>(farthest - section.points.begin())]);
}

}  // namespace

std::optional<LeadingEdgeRange> leading_edge_of(const BladeSections& sections) {
  LeadingEdgeRange range;
  for (const BladeSection& section : sections.sections) {
    const std::optional<double> v = leading_edge_of(section);
    if (!v) return std::nullopt;
    range.v_min = std::min(range.v_min, *v);
    range.v_max = std::max(range.v_max, *v);
  }
  return range;
}

}  // namespace bladefit
