#include "core/localizer/refinement_phase.hpp"

#include <cstddef>

namespace bladefit {
namespace {

constexpr auto kIdle = RefinementPhase::idle, kSquares = RefinementPhase::least_squares, kMode = RefinementPhase::mode,
               kStarts = RefinementPhase::further_starts, kDone = RefinementPhase::done;

/// One row a phase, one column an event, both in the order of their enums.
constexpr RefinementPhase kNext[5][6] = {
    // began, program_began, starts_began, converged, ended_unconverged, interrupted
    {kSquares, kIdle, kIdle, kIdle, kIdle, kIdle},     // idle
    {kSquares, kMode, kSquares, kDone, kIdle, kIdle},  // least_squares
    {kMode, kMode, kStarts, kDone, kIdle, kIdle},      // mode
    {kStarts, kMode, kStarts, kDone, kIdle, kIdle},    // further_starts
    {kDone, kDone, kDone, kDone, kDone, kIdle},        // done
};

}  // namespace

RefinementPhase next_phase(RefinementPhase phase, RefinementEvent event) {
  return kNext[static_cast<std::size_t>(phase)][static_cast<std::size_t>(event)];
}

}  // namespace bladefit
