#include "drivers/text/csv_text.hpp"

#include <fmt/format.h>

#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kQuotedCharacters = 40;

}  // namespace

std::string CsvPlace::say(std::string_view what) const { return fmt::format("{}:{}: {}", name, line, what); }

std::string quoted(std::string_view text) {
  return fmt::format("'{}{}'", text.substr(0, kQuotedCharacters), text.size() > kQuotedCharacters ? "..." : "");
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find_first_of("\r\n");
  const std::string_view line = text.substr(0, end);
  const std::size_t ending = text.substr(line.size()).starts_with("\r\n") ? 2 : 1;
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + ending);
  return trimmed(line);
}

void skip_byte_order_mark(std::string_view& text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
}

std::size_t binary_line(std::string_view text) {
  std::size_t line = 1;
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte < 0x20 && character != '\n' && character != '\r' && character != '\t') return line;
    if (character == '\n') ++line;
  }
  return 0;
}

}  // namespace bladefit
