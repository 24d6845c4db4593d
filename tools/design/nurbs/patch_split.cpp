#include "tools/design/nurbs/patch_split.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

using Extended = long double;
using ExtendedPoint = Eigen::Matrix<Extended, 4, 1>;

/// Parameters nearer to a knot than this part of the range mean the knot.
constexpr Extended kSameSplitKnot = 1e-12L;

/// A spline curve in homogeneous coordinates.
struct Curve {
  std::size_t degree = 0;
  std::vector<Extended> knots;
  std::vector<ExtendedPoint> points;
};

/// Inserts the knot `t` once. Its interval is the one to the right of `t`, at the end of the range the one to the left.
void insert_knot(Curve& curve, Extended t) {
  const auto begin = curve.knots.begin();
  const bool at_end = t >= curve.knots[curve.points.size()];
  const auto behind =
      at_end ? std::lower_bound(begin, curve.knots.end(), t) : std::upper_bound(begin, curve.knots.end(), t);
  const auto k = static_cast<std::size_t>(behind - begin) - 1;
  std::vector<ExtendedPoint> points(curve.points.begin(), curve.points.begin() + static_cast<std::ptrdiff_t>(k + 1));
  for (std::size_t i = k - curve.degree + 1; i <= k; ++i) {
    const Extended alpha = (t - curve.knots[i]) / (curve.knots[i + curve.degree] - curve.knots[i]);
    points[i] = (1 - alpha) * curve.points[i - 1] + alpha * curve.points[i];
  }
  points.insert(points.end(), curve.points.begin() + static_cast<std::ptrdiff_t>(k), curve.points.end());
  curve.points = std::move(points);
  curve.knots.insert(behind, t);
}

/// Inserts `t` until the curve passes through a control point there.
void make_break(Curve& curve, Extended t) {
  auto multiplicity = static_cast<std::size_t>(std::count(curve.knots.begin(), curve.knots.end(), t));
  for (; multiplicity < curve.degree; ++multiplicity) insert_knot(curve, t);
}

/// The part of `curve` between two parameters of its range, over 0..1.
Curve restricted(Curve curve, Extended from, Extended to) {
  make_break(curve, from);
  make_break(curve, to);
  const auto inner_begin = std::upper_bound(curve.knots.begin(), curve.knots.end(), from);
  const auto inner_end = std::lower_bound(inner_begin, curve.knots.end(), to);
  const auto first = inner_begin - curve.knots.begin() - 1 - static_cast<std::ptrdiff_t>(curve.degree);
  const auto last = inner_end - curve.knots.begin() - 1;
  Curve part;
  part.degree = curve.degree;
  part.points.assign(curve.points.begin() + first, curve.points.begin() + last + 1);
  part.knots.assign(curve.degree + 1, 0);
  for (auto knot = inner_begin; knot != inner_end; ++knot) part.knots.push_back((*knot - from) / (to - from));
  part.knots.insert(part.knots.end(), curve.degree + 1, 1);
  return part;
}

/// The knot parameter at a normalised one.
Extended parameter_at(const SurfaceDirection& direction, double normalised) {
  const Extended length = static_cast<Extended>(direction.end) - direction.start;
  const Extended parameter = direction.start + normalised * length;
  for (const double knot : direction.knots) {
    if (std::abs(parameter - knot) <= kSameSplitKnot * length) return knot;
  }
  return parameter;
}

/// The net as curves along u, one for each control point in v.
std::vector<std::vector<ExtendedPoint>> curves_of(const NurbsSurface& surface) {
  const auto count_v = static_cast<std::size_t>(surface.v.control_points);
  std::vector<std::vector<ExtendedPoint>> curves(count_v);
  for (std::size_t k = 0; k < surface.control_points.size(); ++k) {
    ExtendedPoint point;
    point << surface.control_points[k].cast<Extended>() * surface.weights[k], surface.weights[k];
    curves[k % count_v].push_back(point);
  }
  return curves;
}

/// The part of the net over an interval of one direction; the direction is changed to that of the part.
std::vector<std::vector<ExtendedPoint>> restrict_curves(const std::vector<std::vector<ExtendedPoint>>& curves,
                                                        SurfaceDirection& direction, double low, double high) {
  const Extended from = parameter_at(direction, low);
  const Extended to = parameter_at(direction, high);
  const std::vector<Extended> knots(direction.knots.begin(), direction.knots.end());
  std::vector<std::vector<ExtendedPoint>> parts;
  Curve part;
  for (const std::vector<ExtendedPoint>& curve : curves) {
    part = restricted({static_cast<std::size_t>(direction.degree), knots, curve}, from, to);
    parts.push_back(part.points);
  }
  direction.knots.assign(part.knots.begin(), part.knots.end());
  direction.control_points = static_cast<int>(part.points.size());
  direction.start = 0;
  direction.end = 1;
  return parts;
}

std::vector<std::vector<ExtendedPoint>> transposed(const std::vector<std::vector<ExtendedPoint>>& curves) {
  std::vector<std::vector<ExtendedPoint>> result(curves.front().size());
  for (const std::vector<ExtendedPoint>& curve : curves) {
    for (std::size_t k = 0; k < curve.size(); ++k) result[k].push_back(curve[k]);
  }
  return result;
}

}  // namespace

std::vector<ParameterRectangle> divided(const PatchCuts& cuts) {
  const auto limits = [](std::vector<double> inner) {
    inner.insert(inner.begin(), 0.0);
    inner.push_back(1.0);
    return inner;
  };
  const std::vector<double> u = limits(cuts.u);
  const std::vector<double> v = limits(cuts.v);
  std::vector<ParameterRectangle> parts;
  for (std::size_t i = 0; i + 1 < u.size(); ++i) {
    for (std::size_t j = 0; j + 1 < v.size(); ++j) parts.push_back({u[i], u[i + 1], v[j], v[j + 1]});
  }
  return parts;
}

NurbsSurface part_of(const NurbsSurface& surface, const ParameterRectangle& part) {
  NurbsSurface result;
  result.name = "part of " + surface.name;
  result.u = surface.u;
  result.v = surface.v;
  const auto along_u = restrict_curves(curves_of(surface), result.u, part.u_min, part.u_max);
  const auto along_v = restrict_curves(transposed(along_u), result.v, part.v_min, part.v_max);
  for (const std::vector<ExtendedPoint>& curve : along_v) {
    for (const ExtendedPoint& point : curve) {
      result.control_points.emplace_back((point.head<3>() / point[3]).cast<double>());
      result.weights.push_back(static_cast<double>(point[3]));
    }
  }
  return result;
}

}  // namespace bladefit
