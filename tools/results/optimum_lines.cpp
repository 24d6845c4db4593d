#include "tools/results/optimum_lines.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tools/results/zone_counts.hpp"

namespace bladefit {
namespace {

/// "points 12, 81 and 407".
std::string point_list(const Certificate& certificate) {
  std::string text = "points ";
  for (std::uint32_t k = 0; k < certificate.count; ++k) {
    const char* joint = k == 0 ? "" : k + 1 == certificate.count ? " and " : ", ";
    text += fmt::format("{}{}", joint, certificate.sequence.at(k));
  }
  return text;
}

/// How sure it is that no other pose is better, in words.
std::string other_starts(const Result& result) {
  if (result.further_starts == 0) return "";
  return fmt::format("; {} of {} further starts led to it, none to a better one", result.same_optimum,
                     result.further_starts);
}

/// "each zone's tolerances times 1.1342 (the tightest of the leading edge: 0.0567 mm)".
std::string multiplied_tolerances(const Result& result) {
  const ZoneShare share = zone_share(result);
  return fmt::format("the tolerances of the zones and the rest times {:.4f} (the tightest of the {}: {})", share.factor,
                     share.region == Region::leading_edge ? "leading edge" : "blade",
                     length_text(result, share.factor * share.tightest));
}

/// Why no pose meets the tolerances, and how much wider they must be.
std::string infeasible_lines(const Result& result) {
  if (!result.zones.empty()) {
    return fmt::format(
        "Infeasible: {} cannot be brought within the tolerances of their zones together; the least feasible are {}.\n"
        "Measure these points again, or widen the tolerances by that factor\n",
        point_list(result.certificate), multiplied_tolerances(result));
  }
  const FitDetails& details = *result.details;
  const bool leading_edge_judged = std::isfinite(details.leading_edge_tolerance);
  const bool one = result.boxes.empty() || !leading_edge_judged;  // tolerance for the whole blade
  const double wanted = one ? details.rest_tolerance : details.leading_edge_tolerance;
  const double widening =
      result.tolerance_factor / (leading_edge_judged ? details.leading_edge_tolerance : details.rest_tolerance);
  const double least = widening * wanted;
  return fmt::format(
      "Infeasible: {} cannot be brought within {} together; the least feasible {} is {}.\n"
      "Measure these points again, or widen the {}\n",
      point_list(result.certificate), length_text(result, wanted), one ? "rest tolerance" : "leading-edge tolerance",
      length_text(result, least),
      one ? fmt::format("rest tolerance by {}", length_text(result, least - wanted))
          : fmt::format("leading-edge tolerance by {} and the rest tolerance in the same ratio",
                        length_text(result, least - wanted)));
}

}  // namespace

std::string length_text(const Result& result, double mm) {
  return fmt::format("{:.6g} {}", result.in_units(mm), result.units);
}

std::string optimum_lines(const Result& result) {
  const double factor = result.tolerance_factor;
  if (factor <= 0.0 || !result.details) return "";
  const std::string held =
      result.details->held_feet == 0
          ? std::string()
          : fmt::format(" while {} other feet are kept from turning from their probe", result.details->held_feet);
  const std::string proof = fmt::format("Proof: {} cannot all come nearer{} (multipliers balance to {:.1e})\n",
                                        point_list(result.certificate), held, result.details->stationarity);
  switch (result.details->mode) {
    case FitMode::minimax:
      return fmt::format("Largest distance: {}, the smallest found{}\n", length_text(result, factor),
                         other_starts(result)) +
             proof;
    case FitMode::range:
      return fmt::format("Range of distances: {}, the smallest found{}\n", length_text(result, factor),
                         other_starts(result));
    case FitMode::min_tolerance:
      if (!result.zones.empty()) {
        return fmt::format("Smallest tolerances that can be met: {}{}\n", multiplied_tolerances(result),
                           other_starts(result)) +
               proof;
      }
      return fmt::format("Smallest leading-edge tolerance that can be met: {} (rest of blade {}){}\n",
                         length_text(result, factor), length_text(result, result.details->ratio * factor),
                         other_starts(result)) +
             proof;
    case FitMode::constrained:
      return infeasible_lines(result);
    case FitMode::least_squares:
      break;
  }
  return "";
}

}  // namespace bladefit
