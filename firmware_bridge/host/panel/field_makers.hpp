#pragma once
#include <bit>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

#include "firmware_bridge/host/panel/panel_fields.hpp"

/// Rows of the register map from the members of PanelState that they show.
namespace bladefit::panel_rows {

template <typename Value>
std::uint32_t bits_of(Value value) {
  if constexpr (std::is_same_v<Value, float>) {
    return std::bit_cast<std::uint32_t>(value);
  } else {
    return static_cast<std::uint32_t>(value);
  }
}

template <typename Value>
void set_bits(std::uint32_t bits, Value& value) {
  if constexpr (std::is_same_v<Value, float>) {
    value = std::bit_cast<float>(bits);
  } else {
    value = static_cast<Value>(bits);
  }
}

template <typename Value>
constexpr PanelType type_of() {
  if constexpr (std::is_same_v<Value, float>) return PanelType::real;
  return std::is_same_v<Value, std::uint32_t> ? PanelType::wide : PanelType::word;
}

/// A member of the state.
template <auto member>
constexpr PanelField field(std::uint16_t address, PanelUnit unit, std::string_view name, std::string_view meaning) {
  using Value = std::remove_cvref_t<decltype(std::declval<PanelState&>().*member)>;
  return {address,
          type_of<Value>(),
          unit,
          name,
          meaning,
          [](const PanelState& state, std::size_t) { return bits_of(state.*member); },
          [](PanelState& state, std::size_t, std::uint32_t bits) { set_bits(bits, state.*member); }};
}

/// An element of an array of the state.
template <auto member, std::size_t index>
constexpr PanelField element(std::uint16_t address, PanelUnit unit, std::string_view name, std::string_view meaning) {
  using Value = std::remove_cvref_t<decltype((std::declval<PanelState&>().*member)[0])>;
  return {address,
          type_of<Value>(),
          unit,
          name,
          meaning,
          [](const PanelState& state, std::size_t) { return bits_of((state.*member)[index]); },
          [](PanelState& state, std::size_t, std::uint32_t bits) { set_bits(bits, (state.*member)[index]); }};
}

/// A list of the state.
template <auto member, std::uint16_t count>
constexpr PanelField list(std::uint16_t address, std::string_view name, std::string_view meaning) {
  using Value = std::remove_cvref_t<decltype((std::declval<PanelState&>().*member)[0])>;
  constexpr PanelType type = type_of<Value>();
  return {address,
          type,
          PanelUnit::none,
          name,
          meaning,
          [](const PanelState& state, std::size_t item) { return bits_of((state.*member)[item]); },
          [](PanelState& state, std::size_t item, std::uint32_t bits) { set_bits(bits, (state.*member)[item]); },
          count,
          type == PanelType::word ? 1 : 2};
}

/// The same member of each of the newest places.
template <auto member>
constexpr PanelField places(std::uint16_t address, std::uint16_t stride, PanelUnit unit, std::string_view name,
                            std::string_view meaning) {
  using Value = std::remove_cvref_t<decltype(std::declval<PanelPlace&>().*member)>;
  return {address,
          type_of<Value>(),
          unit,
          name,
          meaning,
          [](const PanelState& state, std::size_t item) { return bits_of(state.newest[item].*member); },
          [](PanelState& state, std::size_t item, std::uint32_t bits) { set_bits(bits, state.newest[item].*member); },
          kPanelPlaces,
          stride};
}

/// Always the same value.
template <auto value>
constexpr PanelField constant(std::uint16_t address, std::string_view name, std::string_view meaning) {
  return {address,         type_of<std::remove_const_t<decltype(value)>>(),
          PanelUnit::none, name,
          meaning,         [](const PanelState&, std::size_t) { return bits_of(value); }};
}

inline constexpr std::uint16_t kDefectStride = 20;

constexpr PanelField text(std::uint16_t address, std::uint16_t parts, std::string_view name, std::string_view meaning) {
  return {address, PanelType::text, PanelUnit::none, name, meaning, nullptr, nullptr, parts, kTextRegisters};
}

/// A member of what is told of the blade.
template <auto member>
constexpr PanelField blade(std::uint16_t address, PanelUnit unit, std::string_view name, std::string_view meaning) {
  using Value = std::remove_cvref_t<decltype(std::declval<BladeView&>().*member)>;
  return {address,
          type_of<Value>(),
          unit,
          name,
          meaning,
          [](const PanelState& state, std::size_t) { return bits_of(state.blade.*member); },
          [](PanelState& state, std::size_t, std::uint32_t bits) { set_bits(bits, state.blade.*member); }};
}

/// A list of the blade.
template <auto member, std::uint16_t count>
constexpr PanelField blade_list(std::uint16_t address, std::string_view name, std::string_view meaning) {
  using Value = std::remove_cvref_t<decltype((std::declval<BladeView&>().*member)[0])>;
  return {address,
          type_of<Value>(),
          PanelUnit::none,
          name,
          meaning,
          [](const PanelState& state, std::size_t item) { return bits_of((state.blade.*member)[item]); },
          [](PanelState& state, std::size_t item, std::uint32_t bits) { set_bits(bits, (state.blade.*member)[item]); },
          count,
          1};
}

/// A member of where to probe next.
template <auto member>
constexpr PanelField next(std::uint16_t address, std::string_view name, std::string_view meaning) {
  using Value = std::remove_cvref_t<decltype(std::declval<NextPlace&>().*member)>;
  return {address,
          type_of<Value>(),
          PanelUnit::none,
          name,
          meaning,
          [](const PanelState& state, std::size_t) { return bits_of(state.blade.next.*member); },
          [](PanelState& state, std::size_t, std::uint32_t bits) { set_bits(bits, state.blade.next.*member); }};
}

/// A coordinate of where to probe next, or of the defects.
template <std::size_t axis>
constexpr PanelField next_axis(std::uint16_t address, std::string_view name, std::string_view meaning) {
  return {address,
          PanelType::real,
          PanelUnit::millimetre,
          name,
          meaning,
          [](const PanelState& state, std::size_t) { return bits_of(state.blade.next.machine[axis]); },
          [](PanelState& state, std::size_t, std::uint32_t bits) { set_bits(bits, state.blade.next.machine[axis]); }};
}
template <std::size_t axis>
constexpr PanelField defect_axis(std::uint16_t address, std::string_view name, std::string_view meaning) {
  return {address,
          PanelType::real,
          PanelUnit::millimetre,
          name,
          meaning,
          [](const PanelState& state, std::size_t item) { return bits_of(state.blade.defects[item].machine[axis]); },
          [](PanelState& state, std::size_t item, std::uint32_t bits) {
            set_bits(bits, state.blade.defects[item].machine[axis]);
          },
          BladeView::kDefects,
          kDefectStride};
}

/// The same member of each of the defects.
template <auto member>
constexpr PanelField defects(std::uint16_t address, PanelUnit unit, std::string_view name, std::string_view meaning) {
  using Value = std::remove_cvref_t<decltype(std::declval<BladeDefect&>().*member)>;
  return {address,
          type_of<Value>(),
          unit,
          name,
          meaning,
          [](const PanelState& state, std::size_t item) { return bits_of(state.blade.defects[item].*member); },
          [](PanelState& state, std::size_t item, std::uint32_t bits) {
            set_bits(bits, state.blade.defects[item].*member);
          },
          BladeView::kDefects,
          kDefectStride};
}

}  // namespace bladefit::panel_rows
