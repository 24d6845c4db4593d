#pragma once
#include <string>

#include "tools/report/tolerance_scale.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// The blade spread out from its leading edge: r/R upwards, per cent of the chord to either side, pressure side to the
/// left, suction side to the right. Points by their distance in tolerances, defects and the points of the certificate
/// by name. Empty where the leading edge is not known.
[[nodiscard]] std::string spread_map(const Result& result, const ToleranceScale& scale, const DrawnPoints& drawn);

}  // namespace bladefit
