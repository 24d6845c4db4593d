#include "firmware_bridge/host/panel_map.hpp"

#include <bit>

namespace bladefit {
namespace {

constexpr std::uint32_t kLowWord = 0xFFFF;

/// Walks over registers and writes fields of one or two words, high word first.
class Writer {
 public:
  explicit Writer(std::span<std::uint16_t> registers) : registers_(registers) {}
  Writer& at(std::size_t address) { return next_ = address, *this; }
  Writer& word(std::uint16_t value) { return registers_[next_++] = value, *this; }
  Writer& wide(std::uint32_t value) {
    return word(static_cast<std::uint16_t>(value >> 16U)).word(static_cast<std::uint16_t>(value & kLowWord));
  }
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
  std::uint16_t word() { return registers_[next_++]; }
  std::uint32_t wide() {
    const std::uint32_t high = word();
    return (high << 16U) | word();
  }
  float real() { return std::bit_cast<float>(wide()); }

 private:
  std::span<const std::uint16_t> registers_;
  std::size_t next_ = 0;
};

void encode_counts(const PanelState& state, Writer& to) {
  to.at(0).word(kPanelMapVersion).word(static_cast<std::uint16_t>(state.session));
  to.word(state.fit_status).word(state.alarms);
  to.wide(state.points).wide(state.leading_edge_points).wide(state.leading_edge_out);
  to.wide(state.rest_out).wide(state.rejected);
}

void encode_fit(const PanelState& state, Writer& to) {
  to.at(14).real(state.rms).real(state.leading_edge_rms);
  to.real(state.worst_leading_edge).wide(state.worst_leading_edge_sequence);
  to.real(state.worst_rest).wide(state.worst_rest_sequence);
  for (const float value : state.pose) to.real(value);
}

void encode_last(const PanelState& state, Writer& to) {
  to.at(38).wide(state.last_sequence).real(state.last_distance);
  to.word(static_cast<std::uint16_t>(state.last_state)).word(static_cast<std::uint16_t>(state.last_action));
  to.word(static_cast<std::uint16_t>(state.last_region));
  to.real(state.leading_edge_tolerance).real(state.rest_tolerance).real(state.push_latency_us);
  to.word(state.heartbeat).real(state.smallest_feasible).word(state.determined);
}

void encode_places(const PanelState& state, Writer& to, Writer& to_places) {
  to.at(60);
  for (const PanelPlace& place : state.newest) {
    to.wide(place.sequence).real(place.distance);
    to_places.word(place.patch).real(place.u).real(place.v).real(place.radius);
    to_places.word(static_cast<std::uint16_t>(place.action));
  }
}

void decode_fit(Reader& from, PanelState& state) {
  state.rms = from.at(14).real();
  state.leading_edge_rms = from.real();
  state.worst_leading_edge = from.real();
  state.worst_leading_edge_sequence = from.wide();
  state.worst_rest = from.real();
  state.worst_rest_sequence = from.wide();
  for (float& value : state.pose) value = from.real();
}

void decode_last(Reader& from, PanelState& state) {
  state.last_sequence = from.at(38).wide();
  state.last_distance = from.real();
  state.last_state = static_cast<PointState>(from.word());
  state.last_action = static_cast<Action>(from.word());
  state.last_region = static_cast<Region>(from.word());
  state.leading_edge_tolerance = from.real();
  state.rest_tolerance = from.real();
  state.push_latency_us = from.real();
  state.heartbeat = from.word();
  state.smallest_feasible = from.real();
  state.determined = from.word();
}

void decode_places(Reader& from, std::span<const std::uint16_t> places, PanelState& state) {
  state.has_places = places.size() == kPanelPlaces * kPlaceRegisters;
  Reader from_places(places);
  from.at(60);
  for (PanelPlace& place : state.newest) {
    place = {.sequence = from.wide()};
    place.distance = from.real();
    if (!state.has_places) continue;
    place.patch = from_places.word();
    place.u = from_places.real();
    place.v = from_places.real();
    place.radius = from_places.real();
    place.action = static_cast<Action>(from_places.word());
  }
}

}  // namespace

PanelImage encode_panel(const PanelState& state) {
  PanelImage image;
  Writer to(image.registers);
  Writer to_places(image.places);
  encode_counts(state, to);
  encode_fit(state, to);
  encode_last(state, to);
  encode_places(state, to, to_places);
  image.discrete = {state.leading_edge_out > 0, state.leading_edge_out + state.rest_out > 0,
                    (state.alarms & kAlarmLinkLost) != 0, state.determined == 6};
  return image;
}

bool decode_panel(std::span<const std::uint16_t, kPanelRegisters> registers, std::span<const std::uint16_t> places,
                  PanelState& state) {
  Reader from(registers);
  if (from.word() != kPanelMapVersion) return false;
  state.session = static_cast<SessionState>(from.word());
  state.fit_status = from.word();
  state.alarms = from.word();
  state.points = from.wide();
  state.leading_edge_points = from.wide();
  state.leading_edge_out = from.wide();
  state.rest_out = from.wide();
  state.rejected = from.wide();
  decode_fit(from, state);
  decode_last(from, state);
  decode_places(from, places, state);
  return true;
}

}  // namespace bladefit
