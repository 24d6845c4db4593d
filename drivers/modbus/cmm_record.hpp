#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "core/probe_point.hpp"
#include "drivers/source_settings.hpp"

namespace bladefit {

/// Decodes the registers of one record, map.record_size of them, and checks that it is a good record of the sequence
/// `expected`. Returns what is wrong in words; empty = nothing, then `point` is written, without a time.
[[nodiscard]] std::string decode_record(std::span<const std::uint16_t> registers, const CmmMap& map,
                                        std::uint32_t expected, ProbePoint& point);

}  // namespace bladefit
