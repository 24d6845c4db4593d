#pragma once
#include <cstdint>
#include <vector>

#include "core/localizer.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// What became of the records that a session should have had.
struct StreamEvidence {
  std::vector<SequenceRange> lost;     ///< records that never arrived
  bool lost_unnumbered = false;        ///< points were lost before they had a number
  std::vector<std::uint32_t> refused;  ///< records that arrived and cannot be used
  bool finished = true;                ///< no record is to come
};

/// Judges the blade, once everything else of the result is there; reasons that are in its verdict already are kept.
/// Where the fit itself is in doubt, no point stays in, out, cut or weld: all wait for a better one.
void judge(Result& result, const LocalizerConfig& config, const StreamEvidence& stream);

}  // namespace bladefit
