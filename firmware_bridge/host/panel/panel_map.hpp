#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/inspection/blade_verdict.hpp"

namespace bladefit {

/// Panel register map v1, input registers (function code 4), high word first, float32 in mm and rad.
///
///   0      map version = 1
///   1      SessionState
///   2      fit status: 0 underdetermined, 1 tracking, 2 converged, 3 infeasible
///   3      alarm bits, see PanelAlarm
///   4-5    points                                   6-7    leading-edge points
///   8-9    leading-edge points out of tolerance     10-11  other points out of tolerance
///   12-13  rejected points                          14-15  RMS
///   16-17  leading-edge RMS                         18-19  worst leading-edge distance, signed; 20-21 its sequence
///   22-23  worst distance on the rest; 24-25 its sequence
///   26-37  tx, ty, tz, psi, theta, phi
///   38-39  last sequence; 40-41 its distance; 42 its state; 43 its action; 44 its region
///   45-46  leading-edge tolerance; 47-48 tolerance of the rest (infinity: not judged)
///   49-50  float32 99th percentile of the time that a push takes [us]
///   51     heartbeat, +1 a second
///   52-53  smallest feasible leading-edge tolerance, live, of the modes min_tolerance and constrained; else 0
///   54     determined degrees of freedom
///   60-91  the 8 newest leading-edge points out of tolerance, newest first: uint32 sequence, float32 distance
///
/// Extension, in registers that v1 leaves free; a client must bear its absence (exception 2): for the k-th of those 8
/// points, from 200 + 8 k: uint16 patch, float32 u, float32 v, float32 distance from the shaft axis, uint16 action.
///   264      uint16 1: the optimum of the mode still improves, or not every point was looked at since it did
///   265-280  8 uint32: sequences of the points that prove the smallest feasible tolerance; 0 = no more
///   281      verdict on the blade: 0 not judged, 1 in tolerance, 2 out of tolerance, 3 not decided
///   282      its reasons, see PanelReason
///   283-284  float32 12345.678, 285-286 uint32 0x12345678: they tell a wrong word order
///
/// Discrete inputs (function code 2): 0 leading edge out, 1 any point out, 2 link lost, 3 fit determined, 4 in
/// tolerance, 5 not decided; 6 and 7 are 0.
/// Coils (5, 15), refused unless commands are enabled: 0 start, 1 stop, 2 reset, 3 acknowledge the alarm.
inline constexpr std::uint16_t kPanelMapVersion = 1;
inline constexpr std::size_t kPanelRegisters = 92;
inline constexpr std::size_t kPanelPlaces = 8;
inline constexpr std::uint16_t kPlaceBase = 200;
inline constexpr std::size_t kPlaceRegisters = 8;
inline constexpr std::size_t kPanelSupport = 8;
inline constexpr std::size_t kExtensionRegisters = kPanelPlaces * kPlaceRegisters + 1 + 2 * kPanelSupport + 6;
inline constexpr float kPanelTestReal = 12345.678F;
inline constexpr std::uint32_t kPanelTestWord = 0x12345678;
inline constexpr std::size_t kPanelDiscreteInputs = 8;
inline constexpr std::size_t kPanelCoils = 4;

enum class SessionState : std::uint16_t {
  idle = 0,
  connecting = 1,
  collecting = 2,
  tracking = 3,
  settled = 4,
  fault = 5
};

/// Bits of register 3.
enum PanelAlarm : std::uint16_t {
  kAlarmLeadingEdgeOut = 1,
  kAlarmRestOut = 2,
  kAlarmLinkLost = 4,
  kAlarmDataGap = 8,
  kAlarmMemoryFull = 16,
  kAlarmInfeasible = 32,
};

/// Bits of register 282.
enum PanelReason : std::uint16_t {
  kReasonNotConverged = 1,
  kReasonUnderdetermined = 2,
  kReasonUnproven = 4,
  kReasonPointsMissing = 8,
  kReasonZoneNotProbed = 16,
  kReasonOpen = 32,  ///< points are pending or undecided, or the program is not finished
  kReasonLinkLost = 64,
  kReasonWrongWorld = 128,  ///< wrong units, or a mirrored blade
  kReasonAmbiguous = 256,   ///< another fit may be as good
};

/// The bits that stand for a set of reasons.
[[nodiscard]] std::uint16_t reason_bits(const Reasons& reasons);

/// A leading-edge point out of tolerance. Distances in mm; sequence 0 = no such point.
struct PanelPlace {
  std::uint32_t sequence = 0;
  float distance = 0;
  std::uint16_t patch = 0;
  float u = 0, v = 0;
  float radius = 0;  ///< distance of the foot from the shaft axis
  Action action = Action::none;
};

/// What the panel shows. Lengths in mm, angles in rad.
struct PanelState {
  SessionState session = SessionState::idle;
  std::uint16_t fit_status = 0;
  std::uint16_t alarms = 0;  ///< PanelAlarm bits
  std::uint32_t points = 0, leading_edge_points = 0, leading_edge_out = 0, rest_out = 0, rejected = 0;
  float rms = 0, leading_edge_rms = 0;
  float worst_leading_edge = 0;
  std::uint32_t worst_leading_edge_sequence = 0;
  float worst_rest = 0;
  std::uint32_t worst_rest_sequence = 0;
  std::array<float, 6> pose{};  ///< tx, ty, tz, psi, theta, phi
  std::uint32_t last_sequence = 0;
  float last_distance = 0;
  PointState last_state = PointState::pending;
  Action last_action = Action::none;
  Region last_region = Region::rest;
  float leading_edge_tolerance = 0, rest_tolerance = 0;
  float push_latency_us = 0;
  std::uint16_t heartbeat = 0;
  float smallest_feasible = 0;
  std::uint16_t determined = 0;
  bool improving = false;
  std::array<std::uint32_t, kPanelSupport> support{};  ///< points that prove the smallest tolerance; 0 = no more
  BladeState verdict = BladeState::not_decided;
  std::uint16_t reasons = 0;    ///< PanelReason bits
  bool fit_determined = false;  ///< every degree of freedom that is not locked; not in a register
  bool has_extension =
      false;  ///< whether `verdict`, `improving`, `support` and patch, u, v, radius, action of `newest` are known
  std::array<PanelPlace, kPanelPlaces> newest{};
};

/// What the server answers from.
struct PanelImage {
  std::array<std::uint16_t, kPanelRegisters> registers{};
  std::array<std::uint16_t, kExtensionRegisters> extension{};
  std::array<bool, kPanelDiscreteInputs> discrete{};
};

[[nodiscard]] PanelImage encode_panel(const PanelState& state);

/// Reads a state back from registers 0..91, and from 200..286 or an empty span where the server has no extension.
/// False when the map is of another version; then `state` is as before.
[[nodiscard]] bool decode_panel(std::span<const std::uint16_t, kPanelRegisters> registers,
                                std::span<const std::uint16_t> extension, PanelState& state);

}  // namespace bladefit
