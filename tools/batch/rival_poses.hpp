#pragma once
#include <string>
#include <vector>

#include "tools/batch/fit_options.hpp"
#include "tools/search/candidate_fit.hpp"

namespace bladefit {

/// The part of a fit that is asked for rivals: poses at which the points fit as well.
struct RivalQuestion {
  const DesignImage& design;
  const FitPlan& plan;
  const std::vector<ProbePoint>& points;
  const PoseFit& own;
};

/// A pose at which the points fit as well as at the fit's own.
struct Rival {
  PoseFit fit;            ///< of some of the points
  double own_rms_mm = 0;  ///< of the same points at the fit's own pose
  std::string how;        ///< "turned by 72 degrees about the design's x axis"; empty: reached from another start
};

/// Whether distances of `count` points, of which six are taken up by the pose, may differ so much by chance (an F test
/// at about 95 %).
[[nodiscard]] bool fits_as_well(double rms_mm, double own_rms_mm, std::uint32_t count);

/// Poses turned about the axes of the design by which a propeller's blades follow each other (2 to 9 of them). Cost: a
/// hundred searches of feet where there are none.
[[nodiscard]] std::vector<Rival> other_blades(const RivalQuestion& question);

/// Other optima that few points without probing directions fit as well: the fit begins again from poses about its own
/// and about its start. Empty where there are enough points. Cost: two dozen fits of at most kFewPoints points.
[[nodiscard]] std::vector<Rival> competing_optima(const RivalQuestion& question);

/// Those of the poses found by a search, the best first, that fit as well as the best one and are another pose.
[[nodiscard]] std::vector<Rival> rivals_among(const std::vector<PoseFit>& found, const RivalQuestion& question);

/// "the points were fitted to blade 1 (patch 0), rms 0.047 mm, and fit blade 2 (patch 1) as well, rms 0.047 mm (turned
/// by 120 degrees ...)".
[[nodiscard]] std::string blades_sentence(const RivalQuestion& question, const std::vector<Rival>& rivals);

/// Below so many points without probing directions a fit may end at another optimum.
inline constexpr std::size_t kFewPoints = 50;

/// Whether the start pose chooses the fit's own pose before the rival's: the points are brought less than half as far.
[[nodiscard]] bool start_prefers(const RivalQuestion& question, const Rival& rival);

}  // namespace bladefit
