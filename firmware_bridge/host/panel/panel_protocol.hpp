#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "firmware_bridge/host/panel/panel_map.hpp"

namespace bladefit {

/// Longest Modbus protocol data unit: function code and 252 bytes (Modbus application protocol 1.1b3, 4.1).
inline constexpr std::size_t kLongestPdu = 253;

/// Commands that the coils of one request ask for.
struct PanelCommands {
  bool start = false, stop = false, reset = false, acknowledge = false;
};

/// Answers one Modbus request (function code and data, no header) from the image: reads of input and
/// holding registers, which are the same, discrete inputs and coils, which read 0; who made this (43/14); writes of
/// coils only when `commands_enabled`. Anything else gets the exception that the protocol has for it. `commands` is set
/// by a request that writes coils. Never fails, whatever the bytes are; `request` is not empty.
[[nodiscard]] std::vector<std::uint8_t> answer_panel_request(std::span<const std::uint8_t> request,
                                                             const PanelImage& image, bool commands_enabled,
                                                             PanelCommands& commands);

}  // namespace bladefit
