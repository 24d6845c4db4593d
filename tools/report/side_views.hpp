#pragma once
#include <string>

#include "tools/report/tolerance_scale.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// Pressure and suction side in projected outline, as seen along the shaft, with circles of r/R: the distances in
/// tolerances as a field between the points, and the points. Empty where the sides are not known.
[[nodiscard]] std::string side_views(const Result& result, const ToleranceScale& scale, const DrawnPoints& drawn);

}  // namespace bladefit
