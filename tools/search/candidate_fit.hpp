#pragma once
#include <vector>

#include "core/localizer.hpp"

namespace bladefit {

/// A pose of some points, and how well they fit there. Lengths in mm.
struct PoseFit {
  Pose pose;
  double rms_mm = 0;             ///< of the distances that count
  double typical_mm = 0;         ///< three quarters of all points are nearer to the surface than this
  std::uint32_t counted = 0;     ///< points whose foot is inside the surface
  std::uint32_t points = 0;      ///< all of them
  std::uint32_t determined = 0;  ///< degrees of freedom
  std::uint32_t patch = 0;       ///< that holds the feet of most points
  std::uint32_t told = 0;        ///< points whose direction tells which side was touched
  std::uint32_t averted = 0;     ///< of these, how many run out of the material
  bool settled = false;          ///< the fit came to rest, every foot proven

  /// Most directions run out of the material: the points lie on the wrong side.
  [[nodiscard]] bool is_averted() const { return 2 * averted > told; }
};

/// The least-squares fit of `points` from `start`, by a localizer of its own with the probe of `config` and nothing
/// else of it: feet are the nearest whatever the probing directions, which are counted afterwards. Cost: bounded by a
/// number of sweeps; some milliseconds for 100 points.
[[nodiscard]] PoseFit fit_candidate(const DesignImage& design, const LocalizerConfig& config,
                                    const std::vector<ProbePoint>& points, const Pose& start);

/// The same with the degrees of freedom that `config` locks held at `start`.
[[nodiscard]] PoseFit fit_locked_candidate(const DesignImage& design, const LocalizerConfig& config,
                                           const std::vector<ProbePoint>& points, const Pose& start);

/// How well the points of a finished fit lie: verdicts[i] is that of points[i].
[[nodiscard]] PoseFit measure_fit(const LocalizerConfig& config, const std::vector<ProbePoint>& points,
                                  const FitReport& report, const std::vector<Verdict>& verdicts);

}  // namespace bladefit
