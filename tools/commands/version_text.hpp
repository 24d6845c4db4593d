#pragma once
#include <string>

namespace bladefit {

/// Version and commit, what the processor has that the fit makes use of, and the version of OpenCASCADE, in a line
/// each.
[[nodiscard]] std::string version_text();

}  // namespace bladefit
