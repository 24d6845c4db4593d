#include "tools/design/nurbs/patch_points.hpp"

#include <algorithm>

#include "core/geometry/nearest/global_projection.hpp"

namespace bladefit {
namespace {

bool holds(const PatchWindow& window, std::uint32_t patch, const SurfacePlace& place) {
  const ParameterRectangle& limits = window.limits;
  return window.patch == patch && place.u >= limits.u_min && place.u <= limits.u_max && place.v >= limits.v_min &&
         place.v <= limits.v_max;
}

}  // namespace

std::vector<std::size_t> points_inside(const DesignImage& design, std::span<const ProbePoint> points,
                                       const std::vector<PatchWindow>& windows) {
  const Surface surface(design);
  std::vector<std::size_t> inside;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const ProjectionQuery query{Vec3(points[k].position.data()), Vec3(points[k].approach.data()), 0};
    const SurfacePlace place = project_global(surface, query, nullptr).nearest.place;
    const std::uint32_t patch = surface.span(place.span).patch;
    if (std::any_of(windows.begin(), windows.end(), [&](const auto& w) { return holds(w, patch, place); })) {
      inside.push_back(k);
    }
  }
  return inside;
}

}  // namespace bladefit
