#pragma once
#include <cstdint>

namespace bladefit {

/// Where the fit over all stored points stands.
enum class RefinementPhase : std::uint8_t {
  idle,            ///< not begun, interrupted by a point, or given up
  least_squares,   ///< sweeps move the pose to the least-squares optimum
  mode,            ///< the mode's programs move it on
  further_starts,  ///< a better optimum is sought from other poses
  done             ///< converged: nothing to do until a point comes
};

/// What can happen to it.
enum class RefinementEvent : std::uint8_t {
  began,              ///< refine() was called
  program_began,      ///< of the mode: after least squares, with other regions or another stage, from another pose
  starts_began,       ///< the mode has found an optimum, or none
  converged,          ///< at an optimum, every foot proven
  ended_unconverged,  ///< a cap was met, or the points determine too little
  interrupted,        ///< a point came, or more is wanted of an optimum
};

/// The phase after an event. One that cannot happen in a phase leaves it as it is.
[[nodiscard]] RefinementPhase next_phase(RefinementPhase phase, RefinementEvent event);

}  // namespace bladefit
