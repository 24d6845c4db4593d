#pragma once
#include <cstdint>
#include <span>

#include "core/probe_point.hpp"
#include "drivers/modbus/modbus_settings.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// Decodes the registers of one record, map.record_size of them, and checks that it is a good record of the sequence
/// `expected`, which is written to `point` without a time. Failure `device`: what is wrong in words; then `point` is as
/// before.
[[nodiscard]] Failure decode_record(std::span<const std::uint16_t> registers, const CmmMap& map, std::uint32_t expected,
                                    ProbePoint& point);

}  // namespace bladefit
