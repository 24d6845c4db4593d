#pragma once
#include <cstdint>

#include "core/localizer.hpp"

namespace bladefit {

/// A number that differs (but for one case in 2^64) where two configurations can give different verdicts for the same
/// stream.
[[nodiscard]] std::uint64_t config_digest(const LocalizerConfig& config, std::uint32_t path_refine_points);

}  // namespace bladefit
