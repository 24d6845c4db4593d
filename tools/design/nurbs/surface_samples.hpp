#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "core/fit/pose.hpp"
#include "core/geometry/surface/design_image.hpp"
#include "core/probe_point.hpp"

namespace bladefit {

/// Which points of a design are taken, and how they are measured.
struct SamplePlan {
  std::uint32_t count_u = 2, count_v = 2;  ///< grid on each patch, at least 1 x 1
  double low = 0, high = 1;                ///< normalised parameters of its first and last line; one line: the middle
  std::optional<std::uint32_t> patch;      ///< this patch only
  bool lines_along_v = false;              ///< a scan line has constant u; otherwise constant v
  bool directions = false;                 ///< with approach vectors, against the outward normal
  double offset_mm = 0;                    ///< along the outward normal: excess material, or the radius of a probe ball
  double noise_mm = 0;                     ///< standard deviation along the normal
  std::uint64_t seed = 1;                  ///< of the noise: the same seed gives the same points
  Pose pose;                               ///< moves the points at last: R = pose(r)
};

/// Points of the design in scan order, one path a line, paths counted from 1 over all patches; there are at most 65535
/// paths. Places outside of the trim loops of a patch give none. Cost: one surface evaluation a point.
std::vector<ProbePoint> sample_surface(const DesignImage& design, const SamplePlan& plan);

}  // namespace bladefit
