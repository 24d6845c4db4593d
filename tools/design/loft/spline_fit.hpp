#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// A point in extended precision, in which splines are fitted: results are then good to the last bit or so of a double.
using ExtendedPoint = Eigen::Matrix<long double, 3, 1>;

/// `count` internal knots that divide 0..1 evenly: k / (count + 1).
std::vector<double> uniform_knots(int count);

/// `count` internal knots that divide the parameters into spans of about as many points each
/// (The NURBS Book, eq. 9.68 and 9.69).
std::vector<double> averaged_knots(const std::vector<long double>& parameters, int count);

/// Parameters 0..1 with the ends of the range `degree` + 1 times, so that the curve passes through its first and last
/// control point; `internal` are the knots between, inside 0..1 and never falling.
SurfaceDirection clamped_direction(int degree, const std::vector<double>& internal);

/// Chord-length parameters of `points`, 0 for the first to 1 for the last (The NURBS Book, eq. 9.5). Nothing where all
/// points are the same.
std::optional<std::vector<long double>> chord_parameters(const std::vector<ExtendedPoint>& points);

/// Control points of the spline over `direction` that passes through the first and the last point and has the least sum
/// of squared distances to the others at their parameters (The NURBS Book, section 9.4.1); with as many points as
/// control points it passes through all of them. `parameters` rise from 0 to 1, one a point.
/// Nothing where the parameters do not determine it: some knots then have no parameter between them (Schoenberg and
/// Whitney). Cost: points x degree^2.
std::optional<std::vector<ExtendedPoint>> fit_spline(const SurfaceDirection& direction,
                                                     const std::vector<long double>& parameters,
                                                     const std::vector<ExtendedPoint>& points);

}  // namespace bladefit
