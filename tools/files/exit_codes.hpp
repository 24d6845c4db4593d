#pragma once

namespace bladefit {

/// What the command returns beside 0.
inline constexpr int kOutOfTolerance = 1, kBadInput = 2, kDeviceFailure = 3, kNotDecided = 4;

}  // namespace bladefit
