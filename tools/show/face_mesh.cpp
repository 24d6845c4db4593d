#include "tools/show/face_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace bladefit {
namespace {

/// Lines across a patch on which it is looked at, and steps along them.
constexpr std::array<double, 4> kLines = {0.02, 0.35, 0.65, 0.98};
constexpr std::size_t kSteps = 400;
constexpr std::size_t kMostPoints = 60000, kMostLines = 110, kLeastLines = 9;

/// Rises along a patch with length and bend, from 0 to 1 each, on one line.
std::vector<double> progress(const Surface& surface, std::uint32_t patch, bool along_u, double line) {
  std::vector<double> arcs(kSteps + 1, 0.0), turns(kSteps + 1, 0.0);
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();
  for (std::size_t k = 0; k <= kSteps; ++k) {
    const double t = static_cast<double>(k) / kSteps;
    const SurfacePlace place = along_u ? surface.place_at(patch, t, line) : surface.place_at(patch, line, t);
    const SurfacePoint at = surface.evaluate(place);
    const Vec3 n = surface.normal(place, at);
    if (k > 0) {
      arcs[k] = arcs[k - 1] + (at.s - point).norm();
      turns[k] = turns[k - 1] + std::acos(std::clamp(n.dot(normal), -1.0, 1.0));
    }
    point = at.s;
    normal = n;
  }
  // A bend of less than half a round takes its share of the lines only.
  const double whole = std::max(turns.back(), 3.0), length = arcs.back();
  std::vector<double> share(kSteps + 1);
  for (std::size_t k = 0; k <= kSteps; ++k) {
    const double t = static_cast<double>(k) / kSteps;
    share[k] = (length > 0.0 ? arcs[k] / length : t) + turns[k] / whole + 0.1 * t;
  }
  return share;
}

/// Those of `lines` between two limits, and the limits.
std::vector<double> lines_between(const std::vector<double>& lines, double low, double high) {
  std::vector<double> inside = {low};
  for (const double line : lines) {
    if (line > low && line < high) inside.push_back(line);
  }
  inside.push_back(high);
  return inside;
}

}  // namespace

std::vector<double> mesh_parameters(const Surface& surface, std::uint32_t patch, bool along_u, std::size_t count) {
  std::vector<double> sum(kSteps + 1, 0.0);
  for (const double line : kLines) {
    const std::vector<double> share = progress(surface, patch, along_u, line);
    for (std::size_t k = 0; k <= kSteps; ++k) sum[k] += share[k];
  }
  std::vector<double> parameters = {0.0};
  std::size_t k = 0;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double wanted = sum.back() * static_cast<double>(i) / static_cast<double>(count - 1);
    while (sum[k + 1] < wanted) ++k;
    const double part = (wanted - sum[k]) / (sum[k + 1] - sum[k]);
    parameters.push_back((static_cast<double>(k) + part) / kSteps);
  }
  parameters.push_back(1.0);
  return parameters;
}

FaceMesh mesh_over(const Surface& surface, std::uint32_t patch, std::vector<double> us, std::vector<double> vs) {
  FaceMesh mesh{patch, std::move(us), std::move(vs), {}, {}, 0};
  mesh.points.reserve(mesh.us.size() * mesh.vs.size());
  mesh.normals.reserve(mesh.us.size() * mesh.vs.size());
  for (const double u : mesh.us) {
    for (const double v : mesh.vs) {
      const SurfacePlace place = surface.place_at(patch, u, v);
      const SurfacePoint point = surface.evaluate(place);
      mesh.points.push_back(point.s);
      mesh.normals.push_back(surface.normal(place, point));
    }
  }
  return mesh;
}

std::vector<FaceMesh> mesh_faces(const Surface& surface) {
  const std::size_t patches = surface.image().patches().size();
  const auto even =
      static_cast<std::size_t>(std::sqrt(static_cast<double>(kMostPoints) / static_cast<double>(patches)));
  const std::size_t lines = std::clamp(even, kLeastLines, kMostLines);
  std::vector<FaceMesh> meshes;
  for (std::uint32_t patch = 0; patch < patches; ++patch) {
    meshes.push_back(mesh_over(surface, patch, mesh_parameters(surface, patch, true, lines),
                               mesh_parameters(surface, patch, false, lines)));
  }
  return meshes;
}

FaceMesh mesh_inside(const Surface& surface, const FaceMesh& face, const ParameterBox& box) {
  return mesh_over(surface, box.patch, lines_between(face.us, box.u_min, box.u_max),
                   lines_between(face.vs, box.v_min, box.v_max));
}

}  // namespace bladefit
