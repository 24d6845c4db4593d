#include "core/localizer/mode_plan.hpp"

#include <cmath>
#include <cstddef>

#include "core/localizer/tuning.hpp"

namespace bladefit {
namespace {

using enum FitMode;
using Then = ModeRow::Then;
using Compared = ModeRow::Compared;

/// In the order of FitMode. A range begins with the minimax, from where it meets its best optimum more often: with few
/// points it has several. A constrained fit begins with the smallest feasible tolerance.
constexpr ModeRow kModes[] = {
    // mode, first program, last, sought again, then, compared, value, certificate, value is a tolerance
    {least_squares, least_squares, least_squares, least_squares, Then::ends, Compared::by_distance, false, false,
     false},
    {minimax, minimax, minimax, minimax, Then::ends, Compared::by_distance, true, true, false},
    {range, minimax, range, range, Then::always, Compared::by_range, true, false, false},
    {min_tolerance, min_tolerance, min_tolerance, min_tolerance, Then::ends, Compared::by_bound, true, true, true},
    {constrained, min_tolerance, constrained, min_tolerance, Then::if_feasible, Compared::by_bound, false, false,
     false},
};

constexpr bool in_order() {
  for (std::size_t k = 0; k < std::size(kModes); ++k) {
    if (static_cast<std::size_t>(kModes[k].mode) != k) return false;
  }
  return true;
}
static_assert(std::size(kModes) == kFitModeWords.size() && in_order());

Limits limits_by_zone(const ToleranceMap& map, const Foot& foot) {
  const MapPart part = part_at(map, foot.patch, foot.u, foot.v, foot.point);
  return part.zone != 0 ? map.zones[part.zone - 1].limits() : Limits::both(map.rest_mm);
}

}  // namespace

const ModeRow& mode_row(FitMode mode) { return kModes[static_cast<std::size_t>(mode)]; }

ModePlan::ModePlan(const FitProblem& problem)
    : row_(mode_row(problem.config.mode)),
      bounds_(problem.config.tolerance),
      by_zone_(bounds_.zone_count > 0 && row_.compared == Compared::by_bound) {
  if (may_be_infeasible() || by_zone_) {
    const double edge = tightest_of(bounds_, Region::leading_edge);
    unit_ = std::isfinite(edge) ? edge : tightest_of(bounds_, Region::rest);
  } else {
    bounds_.leading_edge_mm = 1.0;
    bounds_.rest_mm = problem.config.ratio;
  }
}

bool ModePlan::goes_on(double value) const {
  return row_.then == Then::always || (row_.then == Then::if_feasible && value <= 1.0 + tuning::kFeasible);
}

Limits ModePlan::weight(const Foot& foot) const {
  const Limits bound =
      by_zone_ ? limits_by_zone(bounds_, foot) : Limits::both(tolerance_at(bounds_, foot.patch, foot.u, foot.v));
  return std::isfinite(bound.farther()) ? bound : Limits::both(0.0);
}

void ModeOptimum::take(const ModeRow& program, double found, const Certificate& proof) {
  value = program.has_value ? found : 0.0;
  certificate = program.has_certificate ? proof : Certificate();
}

Certificate certificate_of(const ActiveRows& rows, const PointStore& store, double unit) {
  Certificate out;
  out.count = rows.count;
  out.sign = rows.sign;
  for (std::uint32_t k = 0; k < rows.count; ++k) {
    out.multiplier[k] = rows.multiplier[k] * unit;
    out.sequence[k] = store[rows.index[k]].sequence;
  }
  return out;
}

}  // namespace bladefit
