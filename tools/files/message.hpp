#pragma once
#include <string>
#include <string_view>

namespace bladefit {

/// A message as it is told: one line of at most 280 characters. Where it is longer, as with the names of files, its
/// longest words lose their middles, then the line its own, so that its beginning and the way out at its end remain.
[[nodiscard]] std::string one_line(std::string_view message);

/// Says it on standard error, in one line.
void tell(std::string_view message);

}  // namespace bladefit
