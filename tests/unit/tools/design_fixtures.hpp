#pragma once
#include <string>

#include "tests/support/made_surface.hpp"
#include "tests/support/scratch_folder.hpp"

namespace bladefit::testing {

/// `text` with the first `from` replaced by `to`; `from` must be there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace bladefit::testing
