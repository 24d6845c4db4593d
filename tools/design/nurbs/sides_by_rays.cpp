#include "tools/design/nurbs/sides_by_rays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/design/nurbs/facets.hpp"

namespace bladefit {
namespace {

/// Places of a surface that are asked, and lines from each to each side: one along the normal, the others about it.
constexpr std::size_t kRayPlaces = 24;
constexpr int kLines = 7;
/// Lines lean by this from the normal (tangent of the angle).
constexpr double kLean = 0.6;
/// Lines of a side, and places of a surface, that must agree.
constexpr int kAgreeing = 6;
constexpr double kRayMajority = 0.8, kTold = 0.3;

/// A surface's facets and the box around them.
struct Group {
  const Facet* begin;
  const Facet* end;
  Eigen::AlignedBox3d box;
};

struct Line {
  Eigen::Vector3d from, along;
};

/// The line, forwards, meets the box. (Slabs.)
bool meets(const Eigen::AlignedBox3d& box, const Line& line) {
  double near = 0, far = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.min()[axis] - line.from[axis]) / line.along[axis];
    const double b = (box.max()[axis] - line.from[axis]) / line.along[axis];
    if (std::isnan(a) || std::isnan(b)) continue;
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far;
}

/// The line, forwards, crosses the facet. (Moeller and Trumbore, 1997.)
bool crosses(const Facet& facet, const Line& line) {
  const Eigen::Vector3d ab = facet.b - facet.a, ac = facet.c - facet.a;
  const Eigen::Vector3d p = line.along.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0) return false;
  const Eigen::Vector3d to = line.from - facet.a;
  const double u = to.dot(p) / determinant;
  if (u < 0 || u > 1) return false;
  const Eigen::Vector3d q = to.cross(ab);
  const double v = line.along.dot(q) / determinant;
  return v >= 0 && u + v <= 1 && ac.dot(q) / determinant > 0;
}

class Rays {
 public:
  explicit Rays(const FacetedSurfaces& faces) {
    for (std::size_t k = 0; k + 1 < faces.first.size(); ++k) {
      Group group{&faces.facets[faces.first[k]], faces.facets.data() + faces.first[k + 1], {}};
      for (const Facet* f = group.begin; f != group.end; ++f) group.box.extend(f->a).extend(f->b).extend(f->c);
      groups_.push_back(group);
    }
  }

  /// The side of a surface on which most of its places that tell have the outside.
  [[nodiscard]] int side_of(std::size_t k) const {
    const Group& group = groups_[k];
    const auto count = static_cast<std::size_t>(group.end - group.begin);
    double asked = 0, plus = 0, minus = 0;
    for (std::size_t place = 1; place <= kRayPlaces; ++place) {
      const double share = std::fmod(static_cast<double>(place) / std::numbers::phi, 1.0);
      const Facet& facet = group.begin[static_cast<std::size_t>(share * static_cast<double>(count))];
      const double area = facet.area();
      asked += area;
      const int side = side_at(facet);
      if (side > 0) plus += area;
      if (side < 0) minus += area;
    }
    if (plus + minus < kTold * asked || std::max(plus, minus) < kRayMajority * (plus + minus)) return 0;
    return plus > minus ? 1 : -1;
  }

 private:
  [[nodiscard]] int side_at(const Facet& facet) const {
    const double length = facet.cross().norm();
    if (!(length > 0)) return 0;
    const Eigen::Vector3d normal = facet.cross() / length;
    const int above = odd_lines(facet, normal), below = odd_lines(facet, -normal);
    if (above <= kLines - kAgreeing && below >= kAgreeing) return 1;
    if (below <= kLines - kAgreeing && above >= kAgreeing) return -1;
    return 0;
  }

  /// Of the lines to one side of a facet, those that meet the surfaces an odd number of times.
  [[nodiscard]] int odd_lines(const Facet& facet, const Eigen::Vector3d& normal) const {
    const Eigen::Vector3d across = normal.unitOrthogonal(), other = normal.cross(across);
    int odd = 0;
    for (int k = 0; k < kLines; ++k) {
      const double angle = 2 * std::numbers::pi * k / (kLines - 1) + 0.3;
      const double lean = k == kLines - 1 ? 0.01 : kLean;
      const Line line{facet.centre(), normal + lean * (std::cos(angle) * across + std::sin(angle) * other)};
      if (crossings(line, facet) % 2 != 0) ++odd;
    }
    return odd;
  }

  [[nodiscard]] int crossings(const Line& line, const Facet& own) const {
    int count = 0;
    for (const Group& group : groups_) {
      if (!meets(group.box, line)) continue;
      for (const Facet* f = group.begin; f != group.end; ++f) count += f != &own && crosses(*f, line) ? 1 : 0;
    }
    return count;
  }

  std::vector<Group> groups_;
};

}  // namespace

std::vector<int> sides_by_rays(const std::vector<NurbsSurface>& surfaces) {
  const FacetedSurfaces faces = faceted(surfaces);
  const Rays rays(faces);
  std::vector<int> sides;
  for (std::size_t k = 0; k < surfaces.size(); ++k) sides.push_back(rays.side_of(k));
  return sides;
}

}  // namespace bladefit
