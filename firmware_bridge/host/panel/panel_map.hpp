#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "core/inspection/blade_verdict.hpp"
#include "firmware_bridge/host/blade/blade_view.hpp"

namespace bladefit {

// Panel register map v1: input registers (function 4), the same as holding registers (function 3); float32 in mm and
// rad. panel_fields.hpp says what stands where, and `bladefit panel --map` prints it. Registers 0..91 are v1; the
// others, those of the blade from 1000 on too, are an extension, whose absence (exception 2) a client must bear. What
// no field has reads 0.
inline constexpr std::uint16_t kPanelMapVersion = 1;
inline constexpr std::size_t kPanelRegisters = 92;  ///< of v1, from 0
inline constexpr std::size_t kPanelPlaces = 8;
inline constexpr std::uint16_t kExtensionBase = 200;
inline constexpr std::size_t kExtensionRegisters = 90;
inline constexpr std::size_t kPanelListed = 8;  ///< points whose numbers are listed
inline constexpr std::uint16_t kTextBase = 300;
inline constexpr std::size_t kPanelTexts = 6;
inline constexpr std::uint16_t kTextRegisters = 40;     ///< of each text, two characters a register
inline constexpr std::uint16_t kTwinBase = 500;         ///< registers 0..91 again, every float32 as int32
inline constexpr std::size_t kPanelMapRegisters = 600;  ///< that can be read from 0 on
inline constexpr std::uint16_t kBladeBase = 1000;       ///< what is told of places, and of the link in words
inline constexpr std::size_t kBladeRegisters = 720;
inline constexpr std::size_t kPanelDiscreteInputs = 16;
inline constexpr std::size_t kPanelCoils = 4;
inline constexpr float kPanelTestReal = 12345.678F;
inline constexpr std::uint32_t kPanelTestWord = 0x12345678;

/// PanelState::texts, in the order of their addresses.
enum PanelText : std::uint8_t { kVerdictText, kWorstText, kAdviceText, kSourceText, kFaultText, kLossText };

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
  kReasonWrongWorld = 128,   ///< wrong units, or a mirrored blade
  kReasonAmbiguous = 256,    ///< another fit may be as good
  kReasonNoTolerance = 512,  ///< a region is not judged: its tolerance is infinite
  kReasonOtherwise = 1024,   ///< a robust fit judges points otherwise
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
  std::array<std::uint32_t, kPanelListed> support{};  ///< points that prove the smallest tolerance; 0 = no more
  BladeState verdict = BladeState::not_decided;
  std::uint16_t reasons = 0;                            ///< PanelReason bits
  std::uint32_t otherwise_count = 0;                    ///< points that a robust fit judges otherwise; known at the end
  std::array<std::uint32_t, kPanelListed> otherwise{};  ///< the first of them; 0 = no more
  std::uint32_t planned = 0;                            ///< points that will come; 0 = not known
  bool ended = false;                                   ///< the session is over, what is shown is its result
  std::array<std::string, kPanelTexts> texts;           ///< see PanelText
  std::uint32_t link_down_s = 0;                        ///< how long the link has been lost; 0: it is not
  std::uint32_t lost = 0;                               ///< records of the device that never came
  BladeView blade;
  bool has_blade = false;       ///< whether `blade`, `link_down_s`, `lost` and the last three texts are known
  bool fit_determined = false;  ///< every degree of freedom that is not locked; not in a register
  bool has_extension =
      false;  ///< whether `verdict`, `improving`, `support` and patch, u, v, radius, action of `newest` are known
  std::array<PanelPlace, kPanelPlaces> newest{};
};

/// How the panel's numbers are sent.
struct PanelFormat {
  bool low_word_first = false;  ///< of the two registers of a number
  float infinity = 0;  ///< in place of what is not finite, such as the tolerance of a region that is not judged
};

/// What the server answers from.
struct PanelImage {
  std::array<std::uint16_t, kBladeBase + kBladeRegisters> registers{};
  std::array<bool, kPanelDiscreteInputs> discrete{};

  /// Whether registers can be read in one request: of the map, or of the blade.
  [[nodiscard]] static constexpr bool can_read(std::size_t first, std::size_t count) {
    const std::size_t end = first + count;
    return end <= kPanelMapRegisters || (first >= kBladeBase && end <= kBladeBase + kBladeRegisters);
  }
};

[[nodiscard]] PanelImage encode_panel(const PanelState& state, const PanelFormat& format);

/// Reads a state back from registers 0..91, from kExtensionRegisters from kExtensionBase on, and from kBladeRegisters
/// from kBladeBase on; the latter are empty where the server has none. The first three texts are not read. Whichever
/// word comes first is seen from the test number. False when the map is of another version; then `state` is as before.
[[nodiscard]] bool decode_panel(std::span<const std::uint16_t, kPanelRegisters> registers,
                                std::span<const std::uint16_t> extension, std::span<const std::uint16_t> blade,
                                PanelState& state);

}  // namespace bladefit
