#include "config/length.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "drivers/text/text_number.hpp"

namespace bladefit {

Failure parse_length(std::string_view text, Length& length) {
  const std::string_view whole = trimmed(text);
  const std::size_t end = std::min(whole.find_last_of("0123456789.") + 1, whole.size());
  const std::optional<double> number = parse_finite(whole.substr(0, end));
  const std::string_view name = trimmed(whole.substr(end));
  const auto* const unit = std::ranges::find(kUnitWords, name);
  if (!number || (!name.empty() && unit == kUnitWords.end())) {
    return bad_input(fmt::format("'{}' is not a number, nor one with its unit ({}) such as 0.1mm", text,
                                 fmt::join(kUnitWords, ", ")));
  }
  length = {*number, name.empty() ? std::nullopt : std::optional(static_cast<Unit>(unit - kUnitWords.begin()))};
  return {};
}

}  // namespace bladefit
