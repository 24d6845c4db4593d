#pragma once
#include <vector>

#include "tools/batch/first_feet.hpp"
#include "tools/search/owned_localizer.hpp"

namespace bladefit {

/// Refines until the fit has converged or met its own cap. `points`: how many are staged.
void refine_all(Localizer& localizer, std::size_t points);

/// The verdicts of staged points, in their order.
[[nodiscard]] std::vector<Verdict> verdicts_of(const Localizer& localizer, const std::vector<ProbePoint>& points);

}  // namespace bladefit
