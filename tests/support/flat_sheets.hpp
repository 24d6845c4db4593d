#pragma once
#include <vector>

#include "tests/support/compiled_design.hpp"
#include "tools/design/image/image_writer.hpp"

/// Designs made of flat sheets, for what happens where they meet.
namespace bladefit::testing {

inline SurfaceDirection straight(int control_points) {
  SurfaceDirection direction;
  direction.degree = 1;
  direction.control_points = control_points;
  direction.knots.push_back(0.0);
  for (int k = 0; k < control_points; ++k) direction.knots.push_back(k / (control_points - 1.0));
  direction.knots.push_back(1.0);
  direction.end = 1.0;
  return direction;
}

/// Along u through the profile's points, along v a straight way of `length` mm in y, from `start` on. Its normal is
/// that of the profile's direction x y.
inline NurbsSurface flat_sheet(const std::vector<Vec3>& profile, double length = 100.0, double start = 0.0) {
  NurbsSurface surface;
  surface.name = "sheet";
  surface.u = straight(static_cast<int>(profile.size()));
  surface.v = straight(2);
  for (const Vec3& point : profile) {
    for (const double y : {start, start + length}) surface.control_points.emplace_back(point + Vec3(0, y, 0));
  }
  surface.weights.assign(surface.control_points.size(), 1.0);
  return surface;
}

/// The same sheet with the same normal, u and v exchanged, and one of them reversed.
inline NurbsSurface turned_parameters(const NurbsSurface& from) {
  NurbsSurface to = from;
  std::swap(to.u, to.v);
  const int count_u = from.u.control_points, count_v = from.v.control_points;
  to.control_points.clear();
  for (int j = 0; j < count_v; ++j) {
    for (int i = count_u - 1; i >= 0; --i)
      to.control_points.push_back(from.control_points[static_cast<std::size_t>(i * count_v + j)]);
  }
  return to;
}

inline NurbsSurface displaced(NurbsSurface surface, const Vec3& by) {
  for (Eigen::Vector3d& point : surface.control_points) point += by;
  return surface;
}

/// A wedge whose sharp edge is the y axis, 100 mm long: material at x > 0, 60 mm deep and 20 mm thick there.
inline NurbsSurface upper_side() { return flat_sheet({{0, 0, 0}, {60, 0, 10}}); }
inline NurbsSurface lower_side() { return flat_sheet({{60, 0, -10}, {0, 0, 0}}); }

/// Both sides of a section that is sharp in front and ends in a blunt edge, 2 mm thick, towards which they converge by
/// 4 in 30.
inline NurbsSurface upper_side_with_tail() { return flat_sheet({{0, 0, 0}, {30, 0, 5}, {60, 0, 1}}); }
inline NurbsSurface lower_side_with_tail() { return flat_sheet({{60, 0, -1}, {30, 0, -5}, {0, 0, 0}}); }

inline std::vector<std::byte> flat_design(const std::vector<NurbsSurface>& surfaces, int outward = 1) {
  return write_image(surfaces, DesignUnit::mm, outward);
}

}  // namespace bladefit::testing
