#include "tools/batch/path_curve.hpp"

#include <algorithm>

#include "tools/design/loft/spline_fit.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kCubic = 3;

std::vector<ExtendedPoint> extended(std::span<const Vec3> points) {
  std::vector<ExtendedPoint> result;
  for (const Vec3& point : points) result.emplace_back(point.cast<long double>());
  return result;
}

/// Distance from the curve that is still a good start [lengths of the pass].
constexpr double kCloseEnough = 1e-3;

double length_of(std::span<const Vec3> points) {
  double length = 0;
  for (std::size_t k = 1; k < points.size(); ++k) length += (points[k] - points[k - 1]).norm();
  return length;
}

/// Writes the places of points[first..last] to `places`.
void place_piece(std::span<const Vec3> points, std::size_t first, std::size_t last, double close,
                 std::vector<Vec3>& places) {
  const std::size_t count = last - first + 1;
  const std::optional<FittedPath> path = fit_path(points.subspan(first, count));
  if (!path) return;
  double worst = 0;
  for (std::size_t k = 0; k < count; ++k) {
    places[first + k] = path->curve.at(path->parameters[k]);
    worst = std::max(worst, (places[first + k] - points[first + k]).norm());
  }
  if (worst <= close || count <= kCubic + 1) return;
  const std::size_t middle = first + count / 2;
  place_piece(points, first, middle, close, places);
  place_piece(points, middle, last, close, places);
}

}  // namespace

Vec3 PathCurve::at(double t) const {
  std::vector<Vec3> points = control_points;
  for (std::size_t level = points.size() - 1; level > 0; --level) {
    for (std::size_t k = 0; k < level; ++k) points[k] = (1.0 - t) * points[k] + t * points[k + 1];
  }
  return points.front();
}

std::optional<PathCurve> fit_path_curve(std::span<const Vec3> points, std::span<const double> parameters) {
  if (points.size() < 2) return std::nullopt;
  const std::size_t degree = std::min(kCubic, points.size() - 1);
  const std::vector<long double> at(parameters.begin(), parameters.end());
  const auto controls = fit_spline(clamped_direction(static_cast<int>(degree), {}), at, extended(points));
  if (!controls) return std::nullopt;
  PathCurve curve;
  for (const ExtendedPoint& control : *controls) curve.control_points.emplace_back(control.cast<double>());
  return curve;
}

std::optional<FittedPath> fit_path(std::span<const Vec3> points) {
  if (points.size() < 2) return std::nullopt;
  const auto chords = chord_parameters(extended(points));
  if (!chords) return std::nullopt;
  FittedPath path;
  path.parameters.assign(chords->begin(), chords->end());
  const auto curve = fit_path_curve(points, path.parameters);
  if (!curve) return std::nullopt;
  path.curve = *curve;
  return path;
}

std::vector<Vec3> places_on_curves(std::span<const Vec3> points) {
  std::vector<Vec3> places(points.begin(), points.end());
  if (!points.empty()) place_piece(points, 0, points.size() - 1, kCloseEnough * length_of(points), places);
  return places;
}

}  // namespace bladefit
