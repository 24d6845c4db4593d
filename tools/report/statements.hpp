#pragma once
#include <string>
#include <vector>

#include "tools/results/result.hpp"

namespace bladefit {

/// What the optimum of the mode rests on, in words, plain text; empty where the mode has no certificate.
[[nodiscard]] std::vector<std::string> certificate_sentences(const Result& result);

/// How distances were compared with tolerances, and how sure the distances are.
[[nodiscard]] std::vector<std::string> decision_sentences(const Result& result);

/// What did not arrive, and what was not judged.
[[nodiscard]] std::vector<std::string> omission_sentences(const Result& result);

/// Names and values of the fit's settings; empty where no file says.
[[nodiscard]] std::string settings_table(const Result& result);

}  // namespace bladefit
