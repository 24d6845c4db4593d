#pragma once
#include "core/localizer.hpp"
#include "firmware_bridge/bladefit.h"

namespace bladefit {

/// Translates a configuration and checks it for whatever design: that the patches of the boxes exist is left to
/// check_config() with that design. Returns BLADEFIT_OK, BLADEFIT_NOT_FINITE or BLADEFIT_OUT_OF_RANGE.
[[nodiscard]] bladefit_status translate_config(const bladefit_config& from, LocalizerConfig& to);

/// Checks and translates a point; what the localizer checks itself is left to it. Returns BLADEFIT_OK or
/// BLADEFIT_OUT_OF_RANGE.
[[nodiscard]] bladefit_status translate_point(const bladefit_point& from, ProbePoint& to);

[[nodiscard]] bladefit_verdict translate_verdict(const Verdict& from);
[[nodiscard]] bladefit_fit_report translate_report(const FitReport& from);

}  // namespace bladefit
