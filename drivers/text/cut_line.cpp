#include "drivers/text/cut_line.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "drivers/text/csv_text.hpp"

namespace bladefit {
namespace {

/// Fewer lines than this show no habit.
constexpr std::size_t kLeastLines = 5;

std::size_t decimals_of(std::string_view number) {
  const std::size_t mark = number.find_first_of(".,");
  if (mark == std::string_view::npos) return 0;
  constexpr std::string_view kDigits = "0123456789";
  return std::min(number.find_first_not_of(kDigits, mark + 1), number.size()) - mark - 1;
}

}  // namespace

Failure CutLine::check(const std::vector<std::string_view>& cells, bool ended) {
  std::string_view last;
  for (const std::string_view cell : cells) {
    if (!cell.empty()) last = cell;
  }
  const std::size_t decimals = decimals_of(last);
  if (!ended && same_ && lines_ >= kLeastLines && decimals < decimals_.value_or(0)) {
    return bad_input(fmt::format(
        "the last line has no end, and {} fewer decimals than all before it: the file is cut short; complete the line, "
        "or end it with a line break",
        in_quotes(last)));
  }
  same_ = same_ && decimals_.value_or(decimals) == decimals;
  decimals_ = decimals;
  ++lines_;
  return {};
}

}  // namespace bladefit
