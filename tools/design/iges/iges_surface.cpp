#include "tools/design/iges/iges_surface.hpp"

#include <fmt/format.h>

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

[[noreturn]] void fail_count(const IgesParameters& parameters, const NurbsSurface& surface, std::size_t needed) {
  parameters.fail(
      fmt::format("{} parameters, but {} x {} control points of degree {} x {} need {} and U0, U1, V0, V1: number of "
                  "knots or control "
                  "points not matching",
                  parameters.size(), surface.u.control_points, surface.v.control_points, surface.u.degree,
                  surface.v.degree, needed));
}

/// U0 and U1, or V0 and V1.
void read_range(const IgesParameters& parameters, std::size_t place, char letter, SurfaceDirection& direction,
                std::vector<std::string>& notes) {
  const auto value = [&](std::size_t index) {
    return index < parameters.size() && !parameters.text(index).empty() ? parameters.real(index) : 0.0;
  };
  direction.start = value(place);
  direction.end = value(place + 1);
  if (direction.start != 0 || direction.end != 0) return;
  direction.start = direction.knots[static_cast<std::size_t>(direction.degree)];
  direction.end = direction.knots[static_cast<std::size_t>(direction.control_points)];
  notes.push_back(fmt::format("its parameter range {0}0, {0}1 is missing; that of the knots, {1} to {2}, is taken",
                              letter == 'u' ? 'U' : 'V', direction.start, direction.end));
}

}  // namespace

NurbsSurface read_iges_surface(const IgesParameters& parameters, std::vector<std::string>& notes) {
  NurbsSurface surface;
  surface.u.control_points = parameters.integer(1, "upper index K1 in u", 1, kMaxIndex) + 1;
  surface.v.control_points = parameters.integer(2, "upper index K2 in v", 1, kMaxIndex) + 1;
  surface.u.degree = parameters.integer(3, "degree M1 in u", 1, kHighestIgesDegree);
  surface.v.degree = parameters.integer(4, "degree M2 in v", 1, kHighestIgesDegree);
  const std::size_t points =
      static_cast<std::size_t>(surface.u.control_points) * static_cast<std::size_t>(surface.v.control_points);
  const std::size_t needed = kHeadFields + knot_count(surface.u) + knot_count(surface.v) + 4 * points;
  if (parameters.size() < needed) fail_count(parameters, surface, needed);
  surface.weights.resize(points);
  surface.control_points.resize(points);
  Cursor cursor(parameters, kHeadFields);
  read_knots(cursor, surface.u);
  read_knots(cursor, surface.v);
  iges_order(surface, [&](std::size_t k) { surface.weights[k] = cursor.next(); });
  iges_order(surface, [&](std::size_t k) {
    for (double& coordinate : surface.control_points[k]) coordinate = cursor.next();
  });
  if (parameters.size() < needed + kRangeFields) {
    for (std::size_t k = needed; k < parameters.size(); ++k) {
      if (!parameters.text(k).empty() && parameters.real(k) != 0) fail_count(parameters, surface, needed);
    }
  }
  read_range(parameters, needed, 'u', surface.u, notes);
  read_range(parameters, needed + 2, 'v', surface.v, notes);
  return surface;
}

}  // namespace bladefit
