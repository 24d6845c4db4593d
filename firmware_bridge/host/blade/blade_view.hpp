#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/inspection/verdict.hpp"

namespace bladefit {

/// Of a blade that turns ahead: its leading edge goes before, its suction side looks ahead.
enum class BladeSide : std::uint8_t {
  unknown = 0,  ///< no leading edge is set, or the blade is not one whose sides can be told from it
  suction = 1,
  pressure = 2,
  nose = 3  ///< where the leading edge turns from one side to the other
};

/// What is known of a hundredth of the leading edge.
enum class EdgeCell : std::uint8_t {
  not_probed = 0,
  in = 1,
  cut = 2,
  weld = 3,
  pending = 4,
  undecided = 5,
  beyond = 6  ///< out beyond the edge of the design, where there is nothing to cut or to weld to
};

/// Neighbouring points out of tolerance, by the same action. Lengths in mm, places in the frame of the machine.
struct BladeDefect {
  std::uint32_t sequence = 0;          ///< of its worst point; 0 = no such defect
  float from_ratio = 0, to_ratio = 0;  ///< r/R
  float length = 0;                    ///< between its two farthest points
  float distance = 0;                  ///< of the worst point: positive cut, negative weld
  BladeSide side = BladeSide::unknown;
  Action action = Action::none;
  Region region = Region::rest;
  std::uint16_t points = 0;
  std::array<float, 3> machine{};  ///< where the worst point was touched
};

enum class NextReason : std::uint8_t {
  none = 0,             ///< every region has points
  fit_open = 1,         ///< the points leave a direction of the pose open
  edge_not_probed = 2,  ///< a stretch of the leading edge has no point
  rest_not_probed = 3   ///< a side of the blade has none there
};

/// Where a probe tells most.
struct NextPlace {
  NextReason reason = NextReason::none;
  BladeSide side = BladeSide::unknown;
  float ratio = 0;                 ///< r/R
  std::array<float, 3> machine{};  ///< by the present pose [mm]
};

/// What there is to tell of places.
struct BladeView {
  static constexpr std::size_t kCells = 100, kBands = 10, kDefects = 16;
  static constexpr std::uint16_t kNoSurface = 0xFFFF;
  std::array<EdgeCell, kCells> edge{};  ///< from root to tip, evenly in the radius
  float edge_root = 0, edge_tip = 0;    ///< radii of the leading edge's ends [mm]; both 0: no leading edge is set
  float tip = 0;                        ///< R [mm]
  /// Points off the leading edge by tenths of r/R; kNoSurface where the side has none.
  std::array<std::uint16_t, kBands> suction{}, pressure{};
  NextPlace next;
  std::uint32_t defect_count = 0;               ///< in all
  std::array<BladeDefect, kDefects> defects{};  ///< the worst first
};

}  // namespace bladefit
