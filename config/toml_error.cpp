#include "config/toml_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace bladefit {
namespace {

constexpr std::size_t kShown = 60;
constexpr std::string_view kBlanks = " \t\r\f\v";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view line_at(std::string_view text, std::size_t number) {
  for (std::size_t line = 1; line < number; ++line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return trimmed(text.substr(0, text.find('\n')));
}

bool says(const toml::parse_error& error, std::string_view words) {
  return error.description().find(words) != std::string_view::npos;
}

bool has_control_character(std::string_view line) {
  return std::ranges::any_of(line, [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\t') || byte == 0x7F;
  });
}

/// "0,5" and nothing else, a comment apart.
bool is_decimal_comma(std::string_view value) {
  value = trimmed(value.substr(0, value.find('#')));
  const std::size_t comma = value.find(',');
  const auto digits = [](std::string_view part) {
    return !part.empty() && std::ranges::all_of(part, [](unsigned char c) { return std::isdigit(c) != 0; });
  };
  if (comma == std::string_view::npos) return false;
  std::string_view whole = value.substr(0, comma);
  if (whole.starts_with('-') || whole.starts_with('+')) whole.remove_prefix(1);
  return digits(whole) && digits(value.substr(comma + 1));
}

/// What to do about the value of "key = value".
std::string_view cure_of_value(std::string_view value, const toml::parse_error& error) {
  if (value.empty() || value.front() == '#') return "write a value after the '='";
  if (is_decimal_comma(value)) return "write the number with a decimal point";
  if (value.front() == '"' || value.front() == '\'') {
    if (value.find('\\') != std::string_view::npos && (says(error, "escape") || says(error, "hex digit")))
      return "write the text in '...', where a backslash is itself";
    if (value.find(value.front(), 1) == std::string_view::npos)
      return "close the text with the quote that it began with";
    return "write one text in quotes and nothing after it";
  }
  if (value.front() == '[') return "write the list as [a, b], closed by ']'";
  if (says(error, "leading zeroes")) return "write the number without leading zeros";
  if (std::isalpha(static_cast<unsigned char>(value.front())) != 0 || value.front() == '/' || value.front() == '.')
    return "write a text in quotes, true and false in small letters";
  return "write one number, a text in quotes, true, false or a [list]";
}

std::string_view cure_of_line(std::string_view line, const toml::parse_error& error) {
  if (line.starts_with('[')) return "write the name of a table as [name], alone on its line";
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return "write key = value";
  if (equals == 0) return "write a key before the '='";
  return cure_of_value(trimmed(line.substr(equals + 1)), error);
}

std::string described(std::string_view line, const toml::parse_error& error) {
  if (says(error, "utf-8")) return "a byte that is not UTF-8 text; save the file as UTF-8";
  if (has_control_character(line)) return "a control character; save the file as plain text and delete the character";
  if (says(error, "nested value depth")) return "lists or tables nested too deep; no value here is so deep, correct it";
  if (says(error, "redefine") || says(error, "cannot insert"))
    return fmt::format("'{}' is given a second time; keep one of them", excerpt(line));
  if (line.empty() || line.front() == '#' || says(error, "end-of-file")) {
    if (line.empty() || line.find('=') == std::string_view::npos || line.ends_with(']'))
      return "the file ends within a list or a text; close it with ']' or its quotes";
  }
  return fmt::format("'{}' cannot be read; {}", excerpt(line), cure_of_line(line, error));
}

}  // namespace

std::string excerpt(std::string_view found) {
  std::size_t size = std::min(found.size(), kShown);
  const auto goes_on = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  while (size > 0 && size < found.size() && goes_on(found[size])) --size;
  std::string shown(found.substr(0, size));
  std::ranges::replace_if(
      shown, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7F'; }, ' ');
  return size < found.size() ? shown + "..." : shown;
}

std::string toml_error_text(std::string_view text, const toml::parse_error& error) {
  const std::size_t line = error.source().begin.line;
  return fmt::format("{}: {}", line, described(line_at(text, line), error));
}

}  // namespace bladefit
