#include "config/toml_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>

namespace bladefit {
namespace {

constexpr std::size_t kDeepestKey = 32;

/// The first line with a key of more parts than any here has, such as a.a.a.a ..., or 0. The parser would nest a table
/// for each.
std::size_t line_of_deep_key(std::string_view text) {
  constexpr std::string_view kOfKeys = "-_\"' \t";
  std::size_t line = 1, dots = 0;
  for (const char c : text) {
    line += c == '\n' ? 1 : 0;
    const bool letter = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (c == '.') {
      if (++dots >= kDeepestKey) return line;
    } else if (!letter && kOfKeys.find(c) == std::string_view::npos) {
      dots = 0;
    }
  }
  return 0;
}

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Whether a line begins as the header of a table, and something else than a name follows, as in [[=. The parser takes
/// for granted that a name does.
bool is_nameless_header(std::string_view line) {
  std::size_t place = 0;
  const auto skip_blanks = [&] {
    while (place < line.size() && is_blank(line[place])) ++place;
  };
  skip_blanks();
  if (place == line.size() || line[place] != '[') return false;
  ++place;
  if (place < line.size() && line[place] == '[') ++place;
  skip_blanks();
  constexpr std::string_view kOfNames = "-_\"']";
  if (place == line.size()) return true;
  return std::isalnum(static_cast<unsigned char>(line[place])) == 0 &&
         kOfNames.find(line[place]) == std::string_view::npos;
}

/// The first line that begins as the header of a table does, without a name; 0 = there is none.
std::size_t line_of_nameless_header(std::string_view text) {
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (is_nameless_header(text.substr(0, end))) return line;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return 0;
}

/// The place behind the text in quotes that begins at `place`; on one line, or over several where three quotes begin
/// it.
std::size_t behind_quotes(std::string_view text, std::size_t place) {
  const char quote = text[place];
  const std::string three(3, quote);
  const bool lines = text.substr(place, 3) == three;
  std::size_t at = place + (lines ? 3 : 1);
  while (at < text.size()) {
    if (lines ? text.substr(at, 3) == three : text[at] == quote) return at + (lines ? 3 : 1);
    if (!lines && text[at] == '\n') return at;
    at += quote == '"' && text[at] == '\\' ? 2 : 1;
  }
  return text.size();
}

/// The first line with a byte beyond ASCII outside of quotes and comments; 0 = there is none. The parser's table of
/// blanks has no answer for some of those letters.
std::size_t line_of_foreign_letter(std::string_view text) {
  std::size_t place = 0;
  while (place < text.size()) {
    const char c = text[place];
    if (static_cast<unsigned char>(c) >= 0x80)
      return 1 + static_cast<std::size_t>(std::ranges::count(text.substr(0, place), '\n'));
    if (c == '"' || c == '\'') {
      place = behind_quotes(text, place);
    } else {
      place = c == '#' ? std::min(text.find('\n', place), text.size()) : place + 1;
    }
  }
  return 0;
}

}  // namespace

std::string toml_text_fault(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (const std::size_t line = line_of_deep_key(text); line != 0)
    return fmt::format("{}: a key of {} parts or more; no key here has so many, correct it", line, kDeepestKey);
  if (const std::size_t line = line_of_nameless_header(text); line != 0) {
    return fmt::format("{}: a table without a name begins here; write its name between the brackets, such as [panel]",
                       line);
  }
  if (const std::size_t line = line_of_foreign_letter(text); line != 0) {
    return fmt::format(
        "{}: a letter that is not a plain one stands outside of quotes; names here have plain letters, texts stand in "
        "\"\"",
        line);
  }
  return "";
}

}  // namespace bladefit
