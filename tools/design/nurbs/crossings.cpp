#include "tools/design/nurbs/crossings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "tools/design/nurbs/facets.hpp"
#include "tools/design/nurbs/trim_loops.hpp"

namespace bladefit {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Facets of all surfaces together, about, and parts of a surface in each direction.
constexpr double kFacetsOfAll = 20000;
constexpr std::size_t kFewestParts = 6, kMostSheetParts = 32;
/// A crossing is deeper than so many times the distance of the facets from their surfaces.
constexpr double kSags = 4;

/// A triangle of a surface with the parameters of its corners.
struct SheetTriangle {
  std::array<Vector3d, 3> corner;
  std::array<Vector2d, 3> at;  ///< (u, v)
  Eigen::AlignedBox3d box;

  [[nodiscard]] Vector3d normal() const { return (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized(); }
};

/// A surface in triangles.
class Sheet {
 public:
  Sheet(const NurbsSurface& surface, std::size_t parts) : surface_(surface), patch_(extract_bezier(surface)) {
    const auto share = [parts](std::size_t k) { return static_cast<double>(k) / static_cast<double>(parts); };
    std::vector<Vector3d> points;
    for (std::size_t i = 0; i <= parts; ++i) {
      for (std::size_t j = 0; j <= parts; ++j) points.push_back(point_of(patch_, share(i), share(j)));
    }
    const auto add = [&](std::array<std::array<std::size_t, 2>, 3> places) {
      SheetTriangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.corner[k] = points[places[k][0] * (parts + 1) + places[k][1]];
        triangle.at[k] = {share(places[k][0]), share(places[k][1])};
        triangle.box.extend(triangle.corner[k]);
      }
      box_.extend(triangle.box);
      triangles_.push_back(triangle);
    };
    for (std::size_t i = 0; i < parts; ++i) {
      for (std::size_t j = 0; j < parts; ++j) {
        add({{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
        add({{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
      }
    }
  }

  [[nodiscard]] const Eigen::AlignedBox3d& box() const { return box_; }
  [[nodiscard]] bool has(const Vector2d& at) const { return inside_loops(surface_.trims, at.x(), at.y()); }

  /// Those that reach into a box, by the least coordinate along `axis`.
  [[nodiscard]] std::vector<const SheetTriangle*> within(const Eigen::AlignedBox3d& box, int axis) const {
    std::vector<const SheetTriangle*> found;
    for (const SheetTriangle& triangle : triangles_) {
      if (triangle.box.intersects(box)) found.push_back(&triangle);
    }
    std::ranges::sort(found, {}, [axis](const SheetTriangle* triangle) { return triangle->box.min()[axis]; });
    return found;
  }

  /// How far the surface is from the plane of a triangle in the middle of it and of its sides.
  [[nodiscard]] double sag(const SheetTriangle& triangle) const {
    const Vector3d normal = triangle.normal();
    double largest = 0;
    const auto take = [&](const Vector2d& at) {
      largest = std::max(largest, std::abs(normal.dot(point_of(patch_, at.x(), at.y()) - triangle.corner[0])));
    };
    take((triangle.at[0] + triangle.at[1] + triangle.at[2]) / 3);
    for (std::size_t k = 0; k < 3; ++k) take((triangle.at[k] + triangle.at[(k + 1) % 3]) / 2);
    return largest;
  }

 private:
  const NurbsSurface& surface_;
  BezierPatch patch_;
  std::vector<SheetTriangle> triangles_;
  Eigen::AlignedBox3d box_;
};

/// The weights of the corners at a place in the plane of a triangle, inside or not; nothing where it has no area.
std::optional<Vector3d> weights_at(const SheetTriangle& triangle, const Vector3d& place) {
  const Vector3d ab = triangle.corner[1] - triangle.corner[0], ac = triangle.corner[2] - triangle.corner[0],
                 to = place - triangle.corner[0], cross = ab.cross(ac);
  const double square = cross.squaredNorm();
  if (square == 0) return std::nullopt;
  const double b = to.cross(ac).dot(cross) / square, c = ab.cross(to).dot(cross) / square;
  return Vector3d(1 - b - c, b, c);
}

/// A sheet goes on by `depth_mm` to both sides of a plane through a place in its facet: it does not end there.
bool goes_through(const Sheet& sheet, const SheetTriangle& facet, const Vector3d& place, const Vector3d& plane_normal,
                  double depth_mm) {
  constexpr double kLeastSine = 0.01;
  const Vector3d normal = facet.normal(), along = plane_normal - plane_normal.dot(normal) * normal;
  if (along.norm() < kLeastSine) return false;
  for (const int side : {1, -1}) {
    const std::optional<Vector3d> weights = weights_at(facet, place + side * depth_mm / along.squaredNorm() * along);
    if (!weights) return false;
    const Vector2d at = (*weights)[0] * facet.at[0] + (*weights)[1] * facet.at[1] + (*weights)[2] * facet.at[2];
    if (at.minCoeff() < 0 || at.maxCoeff() > 1 || !sheet.has(at)) return false;
  }
  return true;
}

/// Where side k of a triangle passes through another by more than `depth_mm` within both trims.
std::optional<Vector3d> side_through(const Sheet& own, const SheetTriangle& triangle, std::size_t k, const Sheet& other,
                                     const SheetTriangle& facet, double depth_mm) {
  const Vector3d normal = facet.normal(), &from = triangle.corner[k], &to = triangle.corner[(k + 1) % 3];
  const double before = normal.dot(from - facet.corner[0]), after = normal.dot(to - facet.corner[0]);
  if (before * after >= 0 || std::min(std::abs(before), std::abs(after)) <= depth_mm) return std::nullopt;
  const double share = before / (before - after);
  const Vector3d place = from + share * (to - from);
  const std::optional<Vector3d> weights = weights_at(facet, place);
  if (!weights || weights->minCoeff() < 0) return std::nullopt;
  const double depth = depth_mm + kSags * (own.sag(triangle) + other.sag(facet)),
               step = depth / std::abs(after - before);
  if (share - step <= 0 || share + step >= 1) return std::nullopt;
  const Vector2d &start = triangle.at[k], along = triangle.at[(k + 1) % 3] - start;
  const bool own_goes_on = own.has(start + (share - step) * along) && own.has(start + (share + step) * along);
  return own_goes_on && goes_through(other, facet, place, triangle.normal(), depth) ? std::optional(place)
                                                                                    : std::nullopt;
}

/// Grows by the places where two triangles pass through each other.
void add_places(const Sheet& a, const SheetTriangle& one, const Sheet& b, const SheetTriangle& two, double depth_mm,
                Eigen::AlignedBox3d& places) {
  if (!one.box.intersects(two.box)) return;
  for (std::size_t k = 0; k < 3; ++k) {
    if (const auto place = side_through(a, one, k, b, two, depth_mm)) places.extend(*place);
    if (const auto place = side_through(b, two, k, a, one, depth_mm)) places.extend(*place);
  }
}

/// The box of all places where two sheets, or one with itself, pass through each other.
Eigen::AlignedBox3d crossing_places(const Sheet& a, const Sheet& b, double depth_mm) {
  Eigen::AlignedBox3d places;
  const Eigen::AlignedBox3d common = a.box().intersection(b.box());
  if (common.isEmpty()) return places;
  int axis = 0;
  common.sizes().maxCoeff(&axis);
  const std::vector<const SheetTriangle*> ones = a.within(common, axis), twos = b.within(common, axis);
  const double longest = twos.empty() ? 0 : (*std::ranges::max_element(twos, {}, [axis](const SheetTriangle* triangle) {
                                              return triangle->box.sizes()[axis];
                                            }))->box.sizes()[axis];
  for (const SheetTriangle* one : ones) {
    const auto first = std::ranges::lower_bound(twos, one->box.min()[axis] - longest, {},
                                                [axis](const SheetTriangle* two) { return two->box.min()[axis]; });
    for (auto two = first; two != twos.end() && (*two)->box.min()[axis] <= one->box.max()[axis]; ++two) {
      if (&a != &b || one < *two) add_places(a, *one, b, **two, depth_mm, places);
    }
  }
  return places;
}

}  // namespace

std::vector<Crossing> find_crossings(const std::vector<NurbsSurface>& surfaces, double depth_mm) {
  const auto even = static_cast<std::size_t>(std::sqrt(kFacetsOfAll / 2 / static_cast<double>(surfaces.size())));
  std::vector<Sheet> sheets;
  sheets.reserve(surfaces.size());
  for (const NurbsSurface& surface : surfaces)
    sheets.emplace_back(surface, std::clamp(even, kFewestParts, kMostSheetParts));
  std::vector<Crossing> found;
  for (std::size_t a = 0; a < sheets.size(); ++a) {
    for (std::size_t b = a; b < sheets.size(); ++b) {
      const Eigen::AlignedBox3d places = crossing_places(sheets[a], sheets[b], depth_mm);
      if (!places.isEmpty()) found.push_back({a, b, places.diagonal().norm(), places.center()});
    }
  }
  std::ranges::stable_sort(found, std::ranges::greater(), &Crossing::extent_mm);
  return found;
}

}  // namespace bladefit
