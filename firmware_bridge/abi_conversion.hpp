#pragma once
#include "core/localizer.hpp"
#include "firmware_bridge/bladefit.h"

namespace bladefit {

/// Checks every number of `from` and translates it. Returns BLADEFIT_OK, BLADEFIT_NOT_FINITE or BLADEFIT_OUT_OF_RANGE.
[[nodiscard]] bladefit_status translate_config(const bladefit_config& from, LocalizerConfig& to);

/// Checks and translates a point; what the localizer checks itself is left to it. Returns BLADEFIT_OK or
/// BLADEFIT_OUT_OF_RANGE.
[[nodiscard]] bladefit_status translate_point(const bladefit_point& from, ProbePoint& to);

[[nodiscard]] bladefit_verdict translate_verdict(const Verdict& from);
[[nodiscard]] bladefit_fit_report translate_report(const FitReport& from);

}  // namespace bladefit
