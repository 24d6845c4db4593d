#include "core/inspection/decision.hpp"

namespace bladefit {
namespace {

/// Largest standard uncertainty, in tolerances, of a distance that is judged as it is.
constexpr double kMostUncertain = 1.0 / 3.0;

}  // namespace

PointState decide(DecisionRule rule, const JudgedDistance& judged) {
  if (std::isinf(judged.tolerance)) return PointState::in;
  const double size = std::abs(judged.distance), limit = judged.tolerance + judged.touching;
  if (size - judged.expanded > limit) return PointState::out;
  if (rule == DecisionRule::guarded) return size + judged.expanded <= limit ? PointState::in : PointState::undecided;
  if (!(judged.uncertainty < kMostUncertain * judged.tolerance)) return PointState::pending;
  return size > limit ? PointState::out : PointState::in;
}

}  // namespace bladefit
