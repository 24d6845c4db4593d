#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/inspection/limits.hpp"
#include "core/inspection/verdict.hpp"

namespace bladefit {

/// How a distance is compared with its tolerance.
enum class DecisionRule : std::uint8_t {
  simple = 0,  ///< as it is
  guarded = 1  ///< in or out only where the expanded uncertainty leaves no doubt (ISO 14253-1:2017); else undecided
};

/// The words of the rules on the command line, in files and in results, in the order of their values.
inline constexpr std::array<std::string_view, 2> kDecisionRuleWords = {"simple", "guarded"};

constexpr std::string_view word_of(DecisionRule rule) { return kDecisionRuleWords[static_cast<std::size_t>(rule)]; }

/// The rule, and what it needs to know of the probe. The standard uncertainty of a distance that comes from the probe
/// is probe_mm + probe_per_mm L, where L is how far the point is from the middle of the design: what a constant part of
/// the error moves, the fit takes up.
struct Decision {
  DecisionRule rule = DecisionRule::simple;
  double coverage_factor = 2;  ///< k of U = k u
  double probe_mm = 0;         ///< 0 with probe_per_mm 0: not known
  double probe_per_mm = 0;

  /// U = k u of a distance [mm], from the standard uncertainty that comes from the pose and the length L.
  [[nodiscard]] double expanded(double pose_uncertainty_mm, double length_mm) const {
    const double probe = probe_mm + probe_per_mm * length_mm;
    return coverage_factor * std::sqrt(pose_uncertainty_mm * pose_uncertainty_mm + probe * probe);
  }
};

/// A distance, what is allowed, and how far both can be relied on. Lengths in mm.
struct JudgedDistance {
  double distance = 0;
  Limits allowed = Limits::both(0);  ///< both infinite: every distance is in
  double uncertainty = 0;            ///< standard, from the pose
  double expanded = 0;               ///< U of Decision::expanded()
  double touching = 0;               ///< a distance beyond a limit by no more than this is within it
};

/// In, out, pending or undecided. By the simple rule a distance whose standard uncertainty reaches a third of the
/// nearer limit is pending, unless it is out by more than U: few points bend the fit until it passes through them.
[[nodiscard]] PointState decide(DecisionRule rule, const JudgedDistance& judged);

}  // namespace bladefit
