#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// One line a point, lengths in the unit that the names of the columns tell; x, y, z as measured. The tolerance is
/// empty where a point is not judged, the uncertainty where the points do not determine it. Numbers read back as the
/// same bits.
[[nodiscard]] std::string csv_report(const Result& result);

}  // namespace bladefit
