#pragma once
#include <vector>

#include "core/localizer.hpp"
#include "tools/search/candidate_fit.hpp"
#include "tools/search/design_samples.hpp"
#include "tools/search/sample_grid.hpp"

namespace bladefit {

/// Looks for the poses of points of which nothing else is known.
class PoseSearch {
 public:
  /// Samples the design. `design` must outlive it. Cost: some 50 ms.
  PoseSearch(const DesignImage& design, const LocalizerConfig& config);

  /// The poses at which the points fit best, no two of them the same, the best first; at most kMostPoses, none where
  /// there are fewer than six points. Each is the least-squares fit of at most kSearchPoints of the points. Cost:
  /// bounded, some 0.3 s.
  [[nodiscard]] std::vector<PoseFit> poses_of(const std::vector<ProbePoint>& points) const;

  [[nodiscard]] const DesignSamples& samples() const { return samples_; }

 private:
  struct Start {
    Pose pose;
    double misfit = 0;
  };

  [[nodiscard]] std::vector<Start> coarse_starts(const std::vector<Vec3>& points) const;
  void improve(const std::vector<Vec3>& points, std::vector<Start>& starts) const;
  [[nodiscard]] std::vector<Vec3> sites(const std::vector<Vec3>& points) const;

  const DesignImage& design_;
  LocalizerConfig config_;
  DesignSamples samples_;
  SampleGrid grid_;
};

/// Points that a search looks at, and poses that it gives at most.
inline constexpr std::size_t kSearchPoints = 120, kMostPoses = 12;

/// At most `count` of the points, evenly spread over their order.
[[nodiscard]] std::vector<ProbePoint> some_of(const std::vector<ProbePoint>& points, std::size_t count);

/// Root mean square of how far the two poses bring each of the points apart [mm].
[[nodiscard]] double apart(const std::vector<ProbePoint>& points, const Pose& a, const Pose& b);

}  // namespace bladefit
