#pragma once
#include "core/localizer/localizer_parts.hpp"

namespace bladefit {

/// What the parts know of the fit together. Cost: constant.
[[nodiscard]] FitReport report_of(const LocalizerParts& p);

}  // namespace bladefit
