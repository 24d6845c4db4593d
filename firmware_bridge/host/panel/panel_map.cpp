#include "firmware_bridge/host/panel/panel_map.hpp"

#include <array>
#include <bit>
#include <utility>

namespace bladefit {
namespace {

constexpr std::uint32_t kLowWord = 0xFFFF;

/// Walks over registers and writes fields of one or two words, high word first.
class Writer {
 public:
  explicit Writer(std::span<std::uint16_t> registers) : registers_(registers) {}
  Writer& at(std::size_t address) { return next_ = address, *this; }
  template <typename Value>
  Writer& word(Value value) {
    return registers_[next_++] = static_cast<std::uint16_t>(value), *this;
  }
  Writer& wide(std::uint32_t value) { return word(value >> 16U).word(value & kLowWord); }
  Writer& real(float value) { return wide(std::bit_cast<std::uint32_t>(value)); }

 private:
  std::span<std::uint16_t> registers_;
  std::size_t next_ = 0;
};

/// The way back.
class Reader {
 public:
  explicit Reader(std::span<const std::uint16_t> registers) : registers_(registers) {}
  Reader& at(std::size_t address) { return next_ = address, *this; }
  template <typename Value>
  Reader& word(Value& value) {
    return value = static_cast<Value>(registers_[next_++]), *this;
  }
  Reader& wide(std::uint32_t& value) {
    std::uint32_t low = 0;
    word(value).word(low);
    return value = (value << 16U) | low, *this;
  }
  Reader& real(float& value) {
    std::uint32_t bits = 0;
    wide(bits);
    return value = std::bit_cast<float>(bits), *this;
  }

 private:
  std::span<const std::uint16_t> registers_;
  std::size_t next_ = 0;
};

// The map is written once, for both ways: `walk` is a Writer and `state` constant, or a Reader and it is filled.

template <typename Walk, typename State>
void walk_counts(Walk& walk, State& state) {
  walk.at(1).word(state.session).word(state.fit_status).word(state.alarms);
  walk.wide(state.points).wide(state.leading_edge_points).wide(state.leading_edge_out);
  walk.wide(state.rest_out).wide(state.rejected);
}

template <typename Walk, typename State>
void walk_fit(Walk& walk, State& state) {
  walk.at(14).real(state.rms).real(state.leading_edge_rms);
  walk.real(state.worst_leading_edge).wide(state.worst_leading_edge_sequence);
  walk.real(state.worst_rest).wide(state.worst_rest_sequence);
  for (auto& value : state.pose) walk.real(value);
}

template <typename Walk, typename State>
void walk_last(Walk& walk, State& state) {
  walk.at(38).wide(state.last_sequence).real(state.last_distance);
  walk.word(state.last_state).word(state.last_action).word(state.last_region);
  walk.real(state.leading_edge_tolerance).real(state.rest_tolerance).real(state.push_latency_us);
  walk.word(state.heartbeat).real(state.smallest_feasible).word(state.determined);
}

template <typename Walk, typename State>
void walk_newest(Walk& walk, State& state) {
  walk.at(60);
  for (auto& place : state.newest) walk.wide(place.sequence).real(place.distance);
}

template <typename Walk, typename State>
void walk_extension(Walk& walk, State& state) {
  for (auto& place : state.newest) {
    walk.word(place.patch).real(place.u).real(place.v).real(place.radius).word(place.action);
  }
  walk.word(state.improving);
  for (auto& sequence : state.support) walk.wide(sequence);
  walk.word(state.verdict).word(state.reasons);
}

template <typename Walk, typename State>
void walk_registers(Walk& walk, State& state) {
  walk_counts(walk, state);
  walk_fit(walk, state);
  walk_last(walk, state);
  walk_newest(walk, state);
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

PanelImage encode_panel(const PanelState& state) {
  PanelImage image;
  Writer registers(image.registers);
  walk_registers(registers.word(kPanelMapVersion), state);
  Writer extension(image.extension);
  walk_extension(extension, state);
  extension.real(kPanelTestReal).wide(kPanelTestWord);
  image.discrete = {state.leading_edge_out > 0,
                    state.leading_edge_out + state.rest_out > 0,
                    (state.alarms & kAlarmLinkLost) != 0,
                    state.fit_determined,
                    state.verdict == BladeState::in_tolerance,
                    state.verdict == BladeState::not_decided};
  return image;
}

bool decode_panel(std::span<const std::uint16_t, kPanelRegisters> registers, std::span<const std::uint16_t> extension,
                  PanelState& state) {
  Reader reader(registers);
  std::uint16_t version = 0;
  reader.word(version);
  if (version != kPanelMapVersion) return false;
  state.newest.fill({});
  walk_registers(reader, state);
  state.has_extension = extension.size() == kExtensionRegisters;
  Reader extension_reader(extension);
  if (state.has_extension) walk_extension(extension_reader, state);
  return true;
}

}  // namespace bladefit
