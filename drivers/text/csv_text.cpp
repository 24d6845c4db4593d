#include "drivers/text/csv_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace bladefit {
namespace {

constexpr std::size_t kQuotedCharacters = 40;
constexpr std::size_t kListed = 6;
constexpr std::size_t kListedCharacters = 100;
constexpr char kEndOfFile = '\x1A';

/// Two bytes a character: a byte order mark, or a first character whose other byte is 0.
bool is_utf16(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return true;
  return text.size() > 1 && (text[0] == '\0') != (text[1] == '\0');
}

void drop_end_mark(std::string_view& text) {
  const std::size_t mark = text.find(kEndOfFile);
  if (mark == std::string_view::npos) return;
  constexpr std::string_view kPadding("\x1A\0 \t\r\n", 6);
  if (text.find_first_not_of(kPadding, mark) == std::string_view::npos) text = text.substr(0, mark);
}

}  // namespace

std::string CsvPlace::say(std::string_view what) const { return fmt::format("{}:{}: {}", name, line, what); }

std::string lower_case(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return out;
}

std::string in_quotes(std::string_view text) {
  std::string shown(text.substr(0, kQuotedCharacters));
  // A character of UTF-8 is not cut in two.
  if (text.size() > shown.size()) {
    while (!shown.empty() && (static_cast<unsigned char>(text[shown.size()]) & 0xC0U) == 0x80U) shown.pop_back();
  }
  std::ranges::replace_if(
      shown, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7F'; }, '?');
  return fmt::format("'{}{}'", shown, text.size() > kQuotedCharacters ? "..." : "");
}

std::string quoted_list(const std::vector<std::string_view>& texts) {
  std::string list;
  std::size_t listed = 0;
  for (; listed < std::min(texts.size(), kListed); ++listed) {
    const std::string next = in_quotes(texts[listed]);
    if (listed > 0 && list.size() + next.size() > kListedCharacters) break;
    list += fmt::format("{}{}", listed == 0 ? "" : ", ", next);
  }
  if (texts.size() > listed) list += fmt::format(" and {} more", texts.size() - listed);
  return list;
}

std::string_view take_line(std::string_view& text, bool* ended) {
  const std::size_t end = text.find_first_of("\r\n");
  const std::string_view line = text.substr(0, end);
  const std::size_t ending = text.substr(line.size()).starts_with("\r\n") ? 2 : 1;
  if (ended != nullptr) *ended = end != std::string_view::npos;
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + ending);
  return line;
}

Failure strip_marks(std::string_view& text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (is_utf16(text)) return bad_input("the text is UTF-16; save it as CSV in UTF-8");
  if (text.starts_with("PK\x03\x04")) return bad_input("a workbook or packed file; save the table as CSV in UTF-8");
  drop_end_mark(text);
  return {};
}

bool is_binary(std::string_view line) {
  return std::ranges::any_of(line, [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\t'; });
}

}  // namespace bladefit
