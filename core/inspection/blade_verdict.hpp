#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/inspection/verdict.hpp"

namespace bladefit {

/// The one word on a blade that a controller acts on.
enum class BladeState : std::uint8_t {
  not_judged = 0,        ///< no tolerance was set
  in_tolerance = 1,      ///< shown: every zone was probed, every point is within its tolerance
  out_of_tolerance = 2,  ///< shown: a point is out, or no pose meets the tolerances
  not_decided = 3        ///< neither is shown; the reasons say why
};

/// Why a blade is not decided, or what else is to be known beside a decision.
enum class Reason : std::uint8_t {
  not_converged,    ///< the fit did not come to rest at an optimum
  underdetermined,  ///< the points leave directions of the pose open
  unproven,         ///< feet could not be proven the nearest
  wrong_units,      ///< the points are in another unit of length than the design
  mirrored,         ///< the points are those of the mirrored blade
  ambiguous,        ///< another pose, or another blade, fits the points as well
  far_start,        ///< the fit began too far off to be trusted, or the points are of another blade
  points_lost,      ///< points of the device never arrived
  points_refused,   ///< points arrived that cannot be used
  zone_not_probed,  ///< a zone has too few judged points
  pending,          ///< points wait for a better determined fit
  undecided,        ///< points are too near to their tolerance for the uncertainty
  unfinished        ///< the stream ended before the machine said that it is finished
};

/// The words of both in result.json and on the panel, in the order of their values.
inline constexpr std::array<std::string_view, 4> kBladeStateWords = {"not_judged", "in_tolerance", "out_of_tolerance",
                                                                     "not_decided"};
inline constexpr std::array<std::string_view, 13> kReasonWords = {
    "not_converged", "underdetermined", "unproven",        "wrong_units", "mirrored",  "ambiguous", "far_start",
    "points_lost",   "points_refused",  "zone_not_probed", "pending",     "undecided", "unfinished"};

constexpr std::string_view word_of(BladeState state) { return kBladeStateWords[static_cast<std::size_t>(state)]; }
constexpr std::string_view word_of(Reason reason) { return kReasonWords[static_cast<std::size_t>(reason)]; }

/// A set of reasons.
class Reasons {
 public:
  void add(Reason reason) { bits_ |= bit(reason); }
  void add_if(bool holds, Reason reason) {
    if (holds) add(reason);
  }
  [[nodiscard]] bool has(Reason reason) const { return (bits_ & bit(reason)) != 0; }
  [[nodiscard]] bool any() const { return bits_ != 0; }
  /// One that leaves the fit itself in doubt: then no point is judged.
  [[nodiscard]] bool doubt_the_fit() const { return (bits_ & (bit(Reason::points_lost) - 1)) != 0; }

 private:
  static constexpr std::uint32_t bit(Reason reason) { return 1U << static_cast<unsigned>(reason); }
  std::uint32_t bits_ = 0;
};

/// What a verdict on the blade is made from.
struct BladeEvidence {
  bool converged = false;                  ///< the fit is at an optimum, every foot proven
  bool infeasible = false;                 ///< proven: no pose meets the tolerances
  std::uint32_t determined = 0, free = 6;  ///< degrees of freedom: those that the points determine, and all not locked
  std::uint32_t unproven = 0;              ///< feet
  bool judged = false;                     ///< a tolerance is set
  std::uint32_t out = 0, pending = 0, undecided = 0;  ///< points
  std::uint32_t lost = 0, refused = 0;                ///< points
  std::uint32_t zones_missed = 0;                     ///< zones with too few judged points
  bool finished = true;                               ///< no point is to come
  Reasons doubts;                                     ///< what was found against the fit elsewhere
};

struct BladeVerdict {
  BladeState state = BladeState::not_decided;
  Reasons reasons;
  /// The verdict stands on a fit that is itself decided.
  [[nodiscard]] bool fit_decided() const { return !reasons.doubt_the_fit(); }
};

/// The rule: a fit in doubt decides nothing; then a point out, or infeasible tolerances, are out of tolerance; then
/// whatever was not seen leaves the blade not decided. All reasons that hold are told with any state.
[[nodiscard]] BladeVerdict judge_blade(const BladeEvidence& evidence);

/// How many points each zone has that were judged: each of those of the map, or where it has none, of the leading edge.
class ZoneCount {
 public:
  explicit ZoneCount(const ToleranceMap& map) : map_(map) {}
  /// `sign`: 1 to add the point, -1 modulo 2^32 to take it back. In a map with zones a point counts in its own alone.
  void count(const Verdict& verdict, std::uint32_t sign);
  /// Zones with fewer points than each needs; those without a tolerance need none. Cost: linear in the zones.
  [[nodiscard]] std::uint32_t missed() const;
  /// So many places there are: one a zone of the map; where it has none, one a box, of which the first one stands for
  /// its zone.
  [[nodiscard]] std::uint32_t places() const { return map_.zone_count > 0 ? map_.zone_count : map_.box_count; }
  /// Whether the zone at place `k` has fewer points than it needs; false where the place stands for none.
  [[nodiscard]] bool lacks_points(std::uint32_t k) const;
  /// Of the zone at place `k`.
  [[nodiscard]] std::uint32_t points(std::uint32_t k) const { return points_[k]; }
  void clear() { points_ = {}; }

 private:
  const ToleranceMap& map_;
  std::array<std::uint32_t, ToleranceMap::kMaxBoxes> points_{};
};

}  // namespace bladefit
