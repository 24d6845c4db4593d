#pragma once

namespace bladefit {

/// Everything inside is in mm; a length in inches is turned where it comes in, and back where it is written.
inline constexpr double kMmPerInch = 25.4;

}  // namespace bladefit
