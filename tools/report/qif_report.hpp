#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// The result as a QIF 3.0 document (ISO 23952): a point feature and a point-profile characteristic for each point,
/// with its nominal place where the design is at hand, its place as measured moved by the pose, its distance and
/// status, and the status of the inspection. Lengths in the units of the result. Some 1.6 kB a point.
[[nodiscard]] std::string qif_report(const Result& result);

}  // namespace bladefit
