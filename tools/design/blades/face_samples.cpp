#include "tools/design/blades/face_samples.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tools/design/nurbs/facets.hpp"
#include "tools/design/nurbs/trim_loops.hpp"

namespace bladefit {
namespace {

constexpr double kAllPlaces = 60000;
constexpr std::size_t kFewestLines = 8, kMostLines = 24;
/// Derivatives are differences over this part of the range of a parameter.
constexpr double kDifference = 1e-5;

FaceSample sample_at(const BezierPatch& patch, double u, double v, double cell) {
  const Eigen::Vector3d along_u = point_of(patch, u + kDifference, v) - point_of(patch, u - kDifference, v),
                        along_v = point_of(patch, u, v + kDifference) - point_of(patch, u, v - kDifference);
  const Eigen::Vector3d cross = along_u.cross(along_v) / (4 * kDifference * kDifference);
  return {point_of(patch, u, v), cross.normalized(), cross.norm() * cell};
}

std::vector<FaceSample> samples_of(const NurbsSurface& surface, std::size_t lines) {
  const BezierPatch patch = extract_bezier(surface);
  const double step = 1.0 / static_cast<double>(lines);
  std::vector<FaceSample> all, inside;
  for (std::size_t i = 0; i < lines; ++i) {
    for (std::size_t j = 0; j < lines; ++j) {
      const double u = (static_cast<double>(i) + 0.5) * step, v = (static_cast<double>(j) + 0.5) * step;
      all.push_back(sample_at(patch, u, v, step * step));
      if (inside_loops(surface.trims, u, v)) inside.push_back(all.back());
    }
  }
  return inside.empty() ? all : inside;
}

}  // namespace

std::vector<std::vector<FaceSample>> sample_faces(const std::vector<NurbsSurface>& surfaces) {
  const auto even = static_cast<std::size_t>(std::sqrt(kAllPlaces / static_cast<double>(surfaces.size())));
  const std::size_t lines = std::clamp(even, kFewestLines, kMostLines);
  std::vector<std::vector<FaceSample>> samples;
  samples.reserve(surfaces.size());
  for (const NurbsSurface& surface : surfaces) samples.push_back(samples_of(surface, lines));
  return samples;
}

}  // namespace bladefit
