#include "core/inspection/decision.hpp"

namespace bladefit {
namespace {

/// Largest standard uncertainty, in tolerances, of a distance that is judged as it is.
constexpr double kMostUncertain = 1.0 / 3.0;

}  // namespace

PointState decide(DecisionRule rule, const JudgedDistance& judged) {
  const double plus = judged.allowed.plus() + judged.touching, minus = judged.allowed.minus() + judged.touching;
  if (std::isinf(plus) && std::isinf(minus)) return PointState::in;
  const double d = judged.distance, u = judged.expanded;
  if (d - u > plus || -d - u > minus) return PointState::out;
  if (rule == DecisionRule::guarded) return d + u <= plus && u - d <= minus ? PointState::in : PointState::undecided;
  if (!(judged.uncertainty < kMostUncertain * judged.allowed.nearer())) return PointState::pending;
  return d > plus || -d > minus ? PointState::out : PointState::in;
}

}  // namespace bladefit
