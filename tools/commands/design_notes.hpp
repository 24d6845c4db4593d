#pragma once
#include <fmt/format.h>

#include <cstdio>

#include "tools/design/load_design.hpp"

namespace bladefit {

/// Tells what a user should know of a design: notes to `words`, each behind `indent`, a warning to standard error.
inline void tell_notes(const LoadedDesign& design, std::FILE* words, const char* indent = "") {
  for (const std::string& note : design.notes) fmt::print(words, "{}{}\n", indent, note);
  if (!design.warning.empty()) fmt::print(stderr, "bladefit: warning: {}\n", design.warning);
}

}  // namespace bladefit
