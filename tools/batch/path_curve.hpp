#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/surface/foot.hpp"

namespace bladefit {

/// A Bezier curve of degree 3 or less over 0..1.
struct PathCurve {
  std::vector<Vec3> control_points;  ///< degree + 1 of them [mm]

  /// The point at parameter t, by de Casteljau's scheme.
  [[nodiscard]] Vec3 at(double t) const;
};

/// A curve through the points of a pass, and where on it each of them is.
struct FittedPath {
  PathCurve curve;
  std::vector<double> parameters;  ///< one a point, 0 for the first to 1 for the last
};

/// The Bezier curve from the first to the last point with the least sum of squared distances to the others at their
/// parameters, which rise from 0 to 1 (thesis 5.3: a cubic B-spline with no internal knots). Fewer than four points get
/// the curve of lower degree that passes through them. Nothing where there are fewer than two points, or where the
/// parameters of more than two do not determine it. Cost: linear in the points.
[[nodiscard]] std::optional<PathCurve> fit_path_curve(std::span<const Vec3> points, std::span<const double> parameters);

/// The same with chord-length parameters. Nothing also where all points are one.
[[nodiscard]] std::optional<FittedPath> fit_path(std::span<const Vec3> points);

/// Where each point of a pass is on a cubic through it. A pass round the leading edge is no cubic: while a point is
/// farther from its place than a thousandth of the pass' length, the pass is halved, down to pieces of four points.
/// Points that determine no curve are their own places. Cost: points x log points.
[[nodiscard]] std::vector<Vec3> places_on_curves(std::span<const Vec3> points);

}  // namespace bladefit
