#pragma once
#include <string>

#include "core/inspection/blade_verdict.hpp"

namespace bladefit {

/// Why a blade is not decided, or what is to be known beside a decision: what happened, and what to do.
struct VerdictReason {
  Reason code = Reason::not_converged;
  std::string text;
};

}  // namespace bladefit
