#pragma once
#include "tests/bench/bench_case.hpp"

namespace bladefit::bench {

/// How far the farthest corner of the box of the points lies from where the other pose puts it [mm].
double displacement(const FitProblem& problem, const Pose& pose, const Pose& other);

/// max |d| / w at `pose` [mm], every foot searched over the whole design.
double tolerance_at(const BenchDesign& design, const FitCase& fit, const Pose& pose,
                    const std::vector<double>& weights);

/// The least-squares pose among `poses`: of those with the least sum of squares, up to rounding, the one with the
/// smallest gradient.
Pose best_of(const BenchDesign& design, const FitCase& fit, const std::vector<Pose>& poses);

}  // namespace bladefit::bench
