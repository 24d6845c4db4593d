#include "drivers/dro/dro_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kLongestNumber = 64;
constexpr std::string_view kLabels = "xyzXYZ";

bool is_label(char character) { return std::isalpha(static_cast<unsigned char>(character)) != 0; }

/// Cuts the next word off `rest`: a single letter where labels are on, or what stands up to a separator or label.
std::string_view take_word(std::string_view& rest, const DroSettings& settings) {
  const std::size_t first = rest.find_first_not_of(settings.separators);
  if (first == std::string_view::npos) return rest = {};
  rest.remove_prefix(first);
  std::size_t length = std::min(rest.find_first_of(settings.separators), rest.size());
  if (settings.labels) length = is_label(rest.front()) ? 1 : std::min(length, rest.find_first_of(kLabels));
  const std::string_view word = rest.substr(0, length);
  rest.remove_prefix(length);
  return word;
}

std::optional<double> parse_number(std::string_view word, char decimal_mark) {
  if (word.empty() || word.size() > kLongestNumber) return std::nullopt;
  std::string text(word);
  if (decimal_mark != '.') {
    if (text.find('.') != std::string::npos) return std::nullopt;
    std::replace(text.begin(), text.end(), decimal_mark, '.');
  }
  return parse_finite(text);
}

}  // namespace

Failure parse_dro_line(std::string_view line, const DroSettings& settings, std::array<double, 3>& position) {
  std::array<double, 3> read{};
  for (const char axis : settings.order) {
    if (settings.labels) {
      const std::string_view label = take_word(line, settings);
      const bool same = label.size() == 1 && std::tolower(static_cast<unsigned char>(label[0])) == axis;
      if (!same) return bad_input(fmt::format("the label {} is missing", static_cast<char>(std::toupper(axis))));
    }
    const std::optional<double> number = parse_number(take_word(line, settings), settings.decimal_mark);
    const double value = number.value_or(0) * settings.mm_per_unit;
    if (!number || !std::isfinite(value)) {
      return bad_input(fmt::format("no number stands for {}", static_cast<char>(std::toupper(axis))));
    }
    read[static_cast<std::size_t>(axis - 'x')] = value;
  }
  if (line.find_first_not_of(settings.separators) != std::string_view::npos)
    return bad_input("there is more than three numbers");
  position = read;
  return {};
}

}  // namespace bladefit
