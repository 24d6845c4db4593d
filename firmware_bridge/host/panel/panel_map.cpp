#include "firmware_bridge/host/panel/panel_map.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "firmware_bridge/host/panel/panel_fields.hpp"

namespace bladefit {
namespace {

constexpr std::uint32_t kLowWord = 0xFFFF;
constexpr double kLargestTolerance_mm = 1000;  ///< what is shown as larger stands for infinity

using Registers = std::span<std::uint16_t>;

void put_wide(Registers registers, std::size_t address, std::uint32_t value, const PanelFormat& format) {
  const std::size_t low = format.low_word_first ? 0 : 1;
  registers[address + low] = static_cast<std::uint16_t>(value & kLowWord);
  registers[address + 1 - low] = static_cast<std::uint16_t>(value >> 16U);
}

/// ASCII, the first character of a register in its high byte; what is no ASCII becomes '?'.
void put_text(Registers registers, const PanelField& field, const std::string& text) {
  const std::size_t address = field.address;
  const std::size_t length = std::min<std::size_t>(text.size(), 2U * kTextRegisters * field.items);
  for (std::size_t index = 0; index < length; ++index) {
    const char character = text[index];
    const auto byte = static_cast<std::uint8_t>(character >= ' ' && character <= '~' ? character : '?');
    registers[address + index / 2] |= static_cast<std::uint16_t>(index % 2 == 0 ? byte << 8U : byte);
  }
}

/// A text that begins with `first`, up to the first zero.
std::string text_at(std::span<const std::uint16_t> registers, std::size_t first, std::size_t parts) {
  std::string text;
  for (const std::uint16_t word : registers.subspan(first, kTextRegisters * parts)) {
    for (const auto byte : {static_cast<unsigned>(word >> 8U), word & 0xFFU}) {
      if (byte == 0) return text;
      text += static_cast<char>(byte);
    }
  }
  return text;
}

/// Units in the last place of a twin; lengths in mm and angles in rad have a million, or a thousand, in one.
double counts_of(PanelUnit unit) {
  switch (unit) {
    case PanelUnit::millimetre:
      return 1e3;
    case PanelUnit::microsecond:
      return 1;
    case PanelUnit::radian:
    case PanelUnit::none:
      break;
  }
  return 1e6;
}

std::uint32_t twin_of(float value, PanelUnit unit) {
  constexpr double kLeast = std::numeric_limits<std::int32_t>::min(), kMost = std::numeric_limits<std::int32_t>::max();
  const double counts = std::clamp(std::round(static_cast<double>(value) * counts_of(unit)), kLeast, kMost);
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(counts));
}

void put_field(Registers registers, const PanelField& field, const PanelState& state, const PanelFormat& format) {
  for (std::size_t item = 0; item < field.items; ++item) {
    const std::size_t address = field.address + item * field.stride;
    const bool has_twin = address < kPanelRegisters;
    std::uint32_t bits = field.get(state, item);
    if (field.type == PanelType::word) {
      registers[address] = static_cast<std::uint16_t>(bits);
      if (has_twin) registers[kTwinBase + address] = registers[address];
      continue;
    }
    std::uint32_t twin = bits;
    if (field.type == PanelType::real) {
      const auto value = std::bit_cast<float>(bits);
      const float shown = std::isfinite(value) ? value : format.infinity;
      bits = std::bit_cast<std::uint32_t>(shown);
      twin = twin_of(shown, field.unit);
    }
    put_wide(registers, address, bits, format);
    if (has_twin) put_wide(registers, kTwinBase + address, twin, format);
  }
}

/// Sets the fields that lie in `block`, whose first register has the address `base`.
void take_fields(std::span<const std::uint16_t> block, std::size_t base, bool low_word_first, PanelState& state) {
  for (const PanelField& field : panel_fields()) {
    if (field.set == nullptr || field.address < base || field.address >= base + block.size()) continue;
    for (std::size_t item = 0; item < field.items; ++item) {
      const std::size_t place = field.address + item * field.stride - base;
      std::uint32_t bits = block[place];
      if (field.type != PanelType::word) {
        const std::size_t high = low_word_first ? 1 : 0;
        bits = static_cast<std::uint32_t>(block[place + high]) << 16U | block[place + 1 - high];
      }
      field.set(state, item, bits);
    }
  }
}

/// Sets the texts that lie in `block`.
void take_texts(std::span<const std::uint16_t> block, std::size_t base, PanelState& state) {
  std::size_t text = 0;
  for (const PanelField& field : panel_fields()) {
    if (field.type != PanelType::text) continue;
    if (field.address >= base) state.texts[text] = text_at(block, field.address - base, field.items);
    ++text;
  }
}

/// A tolerance that is none, as a sentinel shows it.
void take_back_infinity(float& tolerance) {
  if (!(tolerance > 0) || static_cast<double>(tolerance) >= kLargestTolerance_mm)
    tolerance = std::numeric_limits<float>::infinity();
}

}  // namespace

std::uint16_t reason_bits(const Reasons& reasons) {
  using enum Reason;
  static constexpr std::array<std::pair<Reason, PanelReason>, 13> kBits = {{{not_converged, kReasonNotConverged},
                                                                            {underdetermined, kReasonUnderdetermined},
                                                                            {unproven, kReasonUnproven},
                                                                            {wrong_units, kReasonWrongWorld},
                                                                            {mirrored, kReasonWrongWorld},
                                                                            {ambiguous, kReasonAmbiguous},
                                                                            {far_start, kReasonAmbiguous},
                                                                            {points_lost, kReasonPointsMissing},
                                                                            {points_refused, kReasonPointsMissing},
                                                                            {zone_not_probed, kReasonZoneNotProbed},
                                                                            {pending, kReasonOpen},
                                                                            {undecided, kReasonOpen},
                                                                            {unfinished, kReasonOpen}}};
  unsigned bits = 0;
  for (const auto& [reason, bit] : kBits) {
    if (reasons.has(reason)) bits |= bit;
  }
  return static_cast<std::uint16_t>(bits);
}

PanelImage encode_panel(const PanelState& state, const PanelFormat& format) {
  PanelImage image;
  std::size_t text = 0;
  for (const PanelField& field : panel_fields()) {
    if (field.type == PanelType::text) {
      put_text(image.registers, field, state.texts[text++]);
    } else {
      put_field(image.registers, field, state, format);
    }
  }
  image.discrete = {state.leading_edge_out > 0,
                    state.leading_edge_out + state.rest_out > 0,
                    (state.alarms & kAlarmLinkLost) != 0,
                    state.fit_determined,
                    state.verdict == BladeState::in_tolerance,
                    state.verdict == BladeState::not_decided,
                    state.ended};
  return image;
}

bool decode_panel(std::span<const std::uint16_t, kPanelRegisters> registers, std::span<const std::uint16_t> extension,
                  std::span<const std::uint16_t> blade, PanelState& state) {
  if (registers[0] != kPanelMapVersion) return false;
  constexpr std::size_t kTestWord = 285 - kExtensionBase;
  state.has_extension = extension.size() == kExtensionRegisters;
  const bool low_word_first = state.has_extension && extension[kTestWord] == (kPanelTestWord & kLowWord);
  take_fields(registers, 0, low_word_first, state);
  state.has_blade = state.has_extension && blade.size() == kBladeRegisters;
  if (!state.has_extension) return true;
  take_fields(extension, kExtensionBase, low_word_first, state);
  if (state.has_blade) {
    take_fields(blade, kBladeBase, low_word_first, state);
    take_texts(blade, kBladeBase, state);
  }
  if ((state.reasons & kReasonNoTolerance) == 0) return true;
  take_back_infinity(state.leading_edge_tolerance);
  take_back_infinity(state.rest_tolerance);
  return true;
}

}  // namespace bladefit
