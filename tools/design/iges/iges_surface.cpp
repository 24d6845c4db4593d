#include "tools/design/iges/iges_surface.hpp"

#include <fmt/format.h>

#include "core/geometry/surface/design_image.hpp"

namespace bladefit {
namespace {

constexpr int kMaxIndex = 100000;
/// Entity type, K1, K2, M1, M2 and five properties stand before the first knot.
constexpr std::size_t kHeadFields = 10;
constexpr std::size_t kRangeFields = 4;

/// Hands out the parameters one after another.
class Cursor {
 public:
  Cursor(const IgesParameters& parameters, std::size_t place) : parameters_(parameters), place_(place) {}
  double next() { return parameters_.real(place_++); }

 private:
  const IgesParameters& parameters_;
  std::size_t place_;
};

std::size_t knot_count(const SurfaceDirection& direction) {
  return static_cast<std::size_t>(direction.control_points + direction.degree + 1);
}

void read_knots(Cursor& cursor, SurfaceDirection& direction) {
  direction.knots.resize(knot_count(direction));
  for (double& knot : direction.knots) knot = cursor.next();
}

}  // namespace

NurbsSurface read_iges_surface(const IgesParameters& parameters) {
  NurbsSurface surface;
  surface.u.control_points = parameters.integer(1, "upper index K1 in u", 1, kMaxIndex) + 1;
  surface.v.control_points = parameters.integer(2, "upper index K2 in v", 1, kMaxIndex) + 1;
  surface.u.degree = parameters.integer(3, "degree M1 in u", 1, static_cast<int>(kMaxDegree));
  surface.v.degree = parameters.integer(4, "degree M2 in v", 1, static_cast<int>(kMaxDegree));
  const std::size_t points =
      static_cast<std::size_t>(surface.u.control_points) * static_cast<std::size_t>(surface.v.control_points);
  const std::size_t needed = kHeadFields + knot_count(surface.u) + knot_count(surface.v) + 4 * points + kRangeFields;
  if (parameters.size() < needed) {
    parameters.fail(
        fmt::format("{} parameters, but {} x {} control points of degree {} x {} need {}: number of knots "
                    "or control points not matching",
                    parameters.size(), surface.u.control_points, surface.v.control_points, surface.u.degree,
                    surface.v.degree, needed));
  }
  surface.weights.resize(points);
  surface.control_points.resize(points);
  Cursor cursor(parameters, kHeadFields);
  read_knots(cursor, surface.u);
  read_knots(cursor, surface.v);
  iges_order(surface, [&](std::size_t k) { surface.weights[k] = cursor.next(); });
  iges_order(surface, [&](std::size_t k) {
    for (double& coordinate : surface.control_points[k]) coordinate = cursor.next();
  });
  surface.u.start = cursor.next();
  surface.u.end = cursor.next();
  surface.v.start = cursor.next();
  surface.v.end = cursor.next();
  return surface;
}

Eigen::Affine3d read_iges_matrix(const IgesParameters& parameters) {
  if (parameters.size() < 13) parameters.fail(fmt::format("{} parameters where a matrix needs 13", parameters.size()));
  Cursor cursor(parameters, 1);
  Eigen::Affine3d matrix = Eigen::Affine3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) matrix(row, column) = cursor.next();
  }
  return matrix;
}

}  // namespace bladefit
