#include "tools/show/page_lines.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace bladefit {
namespace {

/// Pieces of a line that is drawn on a patch.
constexpr std::size_t kLineSteps = 96;
/// Where along a line of constant u its label stands, and the two places along one of constant v, one for each side.
constexpr double kLabelAcross = 0.55;
constexpr double kLabelAlong[2] = {0.27, 0.73};

void add_piece(PageLine& line, const Vec3& a, const Vec3& b) {
  line.ends.push_back(a);
  line.ends.push_back(b);
}

/// A line of constant u, or of constant v, over the parameters of the mesh in the other direction.
PageLine iso_line(const Surface& surface, const FaceMesh& mesh, bool constant_u, double constant) {
  PageLine line{constant_u ? LineKind::constant_u : LineKind::constant_v, mesh.patch, "", {}, {}, {}};
  const std::vector<double>& along = constant_u ? mesh.vs : mesh.us;
  std::optional<Vec3> before;
  for (const double t : along) {
    const SurfacePlace place =
        constant_u ? surface.place_at(mesh.patch, constant, t) : surface.place_at(mesh.patch, t, constant);
    const Vec3 point = surface.evaluate(place).s;
    if (before) add_piece(line, *before, point);
    before = point;
  }
  return line;
}

void put_label(const Surface& surface, PageLine& line, double u, double v, std::string label) {
  const SurfacePlace place = surface.place_at(line.patch, u, v);
  const SurfacePoint point = surface.evaluate(place);
  line.label = std::move(label);
  line.label_place = point.s;
  line.label_normal = surface.normal(place, point);
}

/// The level at which an edge of a grid cell is crossed.
std::optional<Vec3> crossing(const Vec3& a, const Vec3& b, double at_a, double at_b) {
  if ((at_a < 0.0) == (at_b < 0.0)) return std::nullopt;
  return Vec3(a + at_a / (at_a - at_b) * (b - a));
}

/// The piece of a level line inside of a triangle.
void cross_triangle(const Vec3 (&corners)[3], const double (&heights)[3], PageLine& line) {
  std::vector<Vec3> found;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (const auto point = crossing(corners[k], corners[next], heights[k], heights[next])) found.push_back(*point);
  }
  if (found.size() == 2) add_piece(line, found[0], found[1]);
}

PageLine ring_at(const FaceMesh& mesh, const std::vector<double>& radii, double radius) {
  PageLine line{LineKind::ring, mesh.patch, "", {}, {}, {}};
  const std::size_t columns = mesh.vs.size();
  for (std::size_t i = 0; i + 1 < mesh.us.size(); ++i) {
    for (std::size_t j = 0; j + 1 < columns; ++j) {
      const std::size_t a = i * columns + j, b = a + columns, c = b + 1, d = a + 1;
      for (const auto& [p, q, r] : {std::array{a, b, c}, std::array{a, c, d}}) {
        cross_triangle({mesh.points[p], mesh.points[q], mesh.points[r]},
                       {radii[p] - radius, radii[q] - radius, radii[r] - radius}, line);
      }
    }
  }
  return line;
}

}  // namespace

std::vector<PageLine> iso_lines(const Surface& surface, const FaceMesh& mesh, double step) {
  std::vector<PageLine> lines;
  const int count = static_cast<int>(std::lround(1.0 / step));
  for (const bool constant_u : {true, false}) {
    for (int k = 0; k <= count; ++k) {
      const double constant = static_cast<double>(k) / count;
      PageLine line = iso_line(surface, mesh, constant_u, constant);
      if (k == 0 || k == count) {
        line.kind = LineKind::edge;
      } else if (constant_u) {
        put_label(surface, line, constant, kLabelAcross, fmt::format("u {:g}", constant));
      } else {
        put_label(surface, line, kLabelAlong[0], constant, fmt::format("v {:g}", constant));
      }
      lines.push_back(line);
      if (lines.back().label.empty() || constant_u) continue;
      // The label once more, on the other side of a blade that the patch goes around.
      PageLine again{line.kind, line.patch, "", {}, {}, {}};
      put_label(surface, again, kLabelAlong[1], constant, line.label);
      lines.push_back(again);
    }
  }
  return lines;
}

std::vector<PageLine> ring_lines(const FaceMesh& mesh, const ShaftAxis& axis, double tip_radius_mm) {
  std::vector<PageLine> lines;
  std::vector<double> radii;
  for (const Vec3& point : mesh.points) radii.push_back(axis.radius_of(point));
  for (int tenth = 1; tenth < 10; ++tenth) {
    PageLine line = ring_at(mesh, radii, 0.1 * tenth * tip_radius_mm);
    if (line.ends.empty()) continue;
    line.label = fmt::format("r/R 0.{}", tenth);
    line.label_place = line.ends.front();
    lines.push_back(line);
  }
  return lines;
}

std::vector<PageLine> ridge_lines(const RidgedBlade& blade) {
  std::vector<PageLine> lines;
  for (std::size_t ridge = 0; ridge < blade.count; ++ridge) {
    PageLine line{LineKind::ridge, blade.start.patch, fmt::format("ridge {}", ridge + 1), {}, {}, {}};
    line.label_place = blade.middle_of(ridge).place.point;
    for (std::size_t k = 1; k < blade.sections.size(); ++k) {
      const auto &a = blade.sections[k - 1].ridges[ridge], &b = blade.sections[k].ridges[ridge];
      if (a && b) add_piece(line, a->place.point, b->place.point);
    }
    lines.push_back(line);
  }
  return lines;
}

}  // namespace bladefit
