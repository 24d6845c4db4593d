#include "tools/results/result.hpp"

#include <algorithm>

#include "tools/files/exit_codes.hpp"
#include "tools/results/words.hpp"

namespace bladefit {

int exit_code_of(const Result& result) {
  if (!result.doubts.empty()) return kNotDecided;
  if (result.status == word_of(FitStatus::infeasible)) return kOutOfTolerance;
  const bool out = std::any_of(result.points.begin(), result.points.end(),
                               [](const ResultPoint& point) { return point.state == PointState::out; });
  return out ? kOutOfTolerance : 0;
}

}  // namespace bladefit
