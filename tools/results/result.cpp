#include "tools/results/result.hpp"

#include "tools/files/exit_codes.hpp"

namespace bladefit {

Reasons ResultVerdict::codes() const {
  Reasons codes;
  for (const VerdictReason& reason : reasons) codes.add(reason.code);
  return codes;
}

int exit_code_of(const Result& result) {
  switch (result.verdict.state) {
    case BladeState::in_tolerance:
      return 0;
    case BladeState::out_of_tolerance:
      return kOutOfTolerance;
    case BladeState::not_judged:
      return result.verdict.fit_decided() ? 0 : kNotDecided;
    case BladeState::not_decided:
      break;
  }
  return kNotDecided;
}

}  // namespace bladefit
