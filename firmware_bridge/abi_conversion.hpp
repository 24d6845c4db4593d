#pragma once
#include <span>

#include "core/localizer.hpp"
#include "firmware_bridge/bladefit.h"
#include "firmware_bridge/bladefit_zones.h"

namespace bladefit {

/// Translates a configuration and checks it for whatever design: that the patches of the boxes exist is left to
/// check_config() with that design. Returns BLADEFIT_OK, BLADEFIT_NOT_FINITE or BLADEFIT_OUT_OF_RANGE.
[[nodiscard]] bladefit_status translate_config(const bladefit_config& from, LocalizerConfig& to);

/// Puts zones in place of the boxes of `map`; what the localizer's configuration checks is left to that. The axis,
/// which may be null, has its struct_size. Returns BLADEFIT_OK, NULL_ARGUMENT, MISALIGNED, BAD_SIZE or OUT_OF_RANGE:
/// then `map` is undefined.
[[nodiscard]] bladefit_status translate_zones(std::span<const bladefit_zone> zones, const bladefit_axis* axis,
                                              ToleranceMap& map);

/// Checks and translates a point; what the localizer checks itself is left to it. Returns BLADEFIT_OK or
/// BLADEFIT_OUT_OF_RANGE.
[[nodiscard]] bladefit_status translate_point(const bladefit_point& from, ProbePoint& to);

[[nodiscard]] bladefit_verdict translate_verdict(const Verdict& from);
[[nodiscard]] bladefit_fit_report translate_report(const FitReport& from);

}  // namespace bladefit
