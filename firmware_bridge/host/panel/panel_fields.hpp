#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware_bridge/host/panel/panel_map.hpp"

namespace bladefit {

enum class PanelType : std::uint8_t {
  word,  ///< uint16
  wide,  ///< uint32
  real,  ///< float32
  text   ///< ASCII, kTextRegisters; `items` of them are one long text
};

/// Units of the float32, which say what their twin counts in: micrometres, microradians, microseconds, millionths.
enum class PanelUnit : std::uint8_t { none, millimetre, radian, microsecond };

/// What stands in registers: a value, or `items` of its kind, each `stride` registers behind the one before.
struct PanelField {
  std::uint16_t address = 0;
  PanelType type = PanelType::word;
  PanelUnit unit = PanelUnit::none;
  std::string_view name;
  std::string_view meaning;
  std::uint32_t (*get)(const PanelState& state, std::size_t item) = nullptr;       ///< the bits; null for a text
  void (*set)(PanelState& state, std::size_t item, std::uint32_t bits) = nullptr;  ///< null: is not read back
  std::uint16_t items = 1;
  std::uint16_t stride = 0;
};

/// The map: every field in rising order of address, of v1, of the extension and of the blade, without the twins.
[[nodiscard]] std::span<const PanelField> panel_fields();

/// A bit that can be read or pressed.
struct PanelBit {
  std::string_view name;
  std::string_view meaning;
};

/// Discrete inputs from 0 on; those up to kPanelDiscreteInputs that are not named read 0.
[[nodiscard]] std::span<const PanelBit> panel_inputs();

/// Coils from 0 on.
[[nodiscard]] std::span<const PanelBit> panel_coils();

/// Registers that a value of a type takes.
[[nodiscard]] std::uint16_t register_count(PanelType type);

}  // namespace bladefit
