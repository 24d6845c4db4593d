#pragma once
#include <span>
#include <vector>

#include "core/geometry/surface/design_image.hpp"
#include "core/probe_point.hpp"
#include "tools/design/nurbs/patch_split.hpp"

namespace bladefit {

/// A rectangle of parameters on one patch of a design.
struct PatchWindow {
  std::uint32_t patch = 0;
  ParameterRectangle limits;
};

/// Numbers, counted from 0, of the points whose foot as they stand lies in one of `windows`, limits included.
/// Cost: one global projection a point.
std::vector<std::size_t> points_inside(const DesignImage& design, std::span<const ProbePoint> points,
                                       const std::vector<PatchWindow>& windows);

}  // namespace bladefit
