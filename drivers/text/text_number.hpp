#pragma once
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace bladefit {

/// The text without blanks and tabs at both ends.
[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// A finite decimal number that fills the whole text, one leading + allowed; nothing otherwise. Ignores the locale.
[[nodiscard]] inline std::optional<double> parse_finite(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// An unsigned decimal whole number of the type's range that fills the whole text; nothing otherwise.
template <typename Integer>
[[nodiscard]] std::optional<Integer> parse_whole(std::string_view text) {
  Integer value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace bladefit
