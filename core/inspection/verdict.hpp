#pragma once
#include <cstdint>

#include "core/geometry/surface/foot.hpp"
#include "core/inspection/tolerance_map.hpp"

namespace bladefit {

enum class PointState : std::uint8_t {
  pending = 0,   ///< the fit is not determined well enough to judge it
  in = 1,        ///< within its tolerance
  out = 2,       ///< beyond it
  rejected = 3,  ///< left out of fit and judgement
  undecided = 4  ///< guarded: nearer to its tolerance than its uncertainty; always: far beyond an edge of the design
};
enum class Action : std::uint8_t { none = 0, cut = 1, weld = 2 };

/// Why a point is rejected.
enum class LeftOut : std::uint8_t {
  none = 0,    ///< it is not
  window = 1,  ///< its foot at the start pose lies outside of the window
  edge = 2     ///< its foot lies on an outer edge of the design, and it is not beyond by more than the tolerance there
};

/// What is known of one point at one revision of the fit.
struct Verdict {
  std::uint32_t sequence = 0;
  Foot foot;
  Region region = Region::rest;
  std::uint8_t zone = 0;      ///< of the tolerance map, from 1; 0: none of them
  double tolerance_mm = 0;    ///< |distance| allowed at the foot, on the side of the distance; infinity: none was set
  double uncertainty_mm = 0;  ///< standard uncertainty of the distance that comes from the pose
  double expanded_mm = 0;     ///< expanded uncertainty of the distance, that of the probe included where it is known
  PointState state = PointState::pending;
  Action action = Action::none;  ///< cut or weld where the state is out; none where the design ends: what lies beyond
                                 ///< it by more than the tolerance is out, but there is no surface to cut or weld to
  LeftOut left_out = LeftOut::none;  ///< where the state is rejected
  bool fitted = false;               ///< it counts in the fit: that and being judged are two things
  std::uint32_t revision = 0;        ///< fit revision it was judged at
};

/// Whether a point in this state was judged.
[[nodiscard]] constexpr bool is_judged(PointState state) { return state == PointState::in || state == PointState::out; }

/// False for a record that the localizer could not use, such as one with a number that is not finite.
[[nodiscard]] inline bool has_foot(const Verdict& verdict) { return !verdict.foot.normal.isZero(); }

}  // namespace bladefit
