#include "tools/report/report_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bladefit {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Bytes of the character that the text begins with; 0 = it is none that XML allows. RFC 3629: no overlong forms, no
/// surrogates, nothing above U+10FFFF; nor U+FFFE and U+FFFF.
std::size_t character_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  std::uint32_t code = first & (0xFFU >> (length + 1));
  for (std::size_t k = 1; k < length; ++k) {
    if (!is_continuation(text[k])) return 0;
    code = code << 6U | (static_cast<unsigned char>(text[k]) & 0x3FU);
  }
  const std::uint32_t least = length == 2 ? 0x80 : length == 3 ? 0x800 : 0x10000;
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < least || surrogate || code > 0x10FFFF || (code & 0xFFFEU) == 0xFFFEU || code < 0xA0 ? 0 : length;
}

}  // namespace

std::string clean_text(std::string_view text) {
  std::string clean;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    clean += length == 0 ? kReplacement : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return clean;
}

std::string shortened(std::string_view text, std::size_t most) {
  const std::string clean = clean_text(text);
  if (clean.size() <= most) return clean;
  const std::string_view all(clean);
  std::size_t head = most / 2, tail = clean.size() - most / 2;
  while (head > 0 && is_continuation(all[head])) --head;
  while (tail < all.size() && is_continuation(all[tail])) ++tail;
  return fmt::format("{} ... {}", all.substr(0, head), all.substr(tail));
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : clean_text(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string LengthText::plain(double length) const {
  return std::isfinite(length) ? fmt::format("{:.{}f}", result_.in_units(length), decimals_) : "-";
}

std::string LengthText::with_sign(double length) const {
  return fmt::format("{:+.{}f}", result_.in_units(length), decimals_);
}

std::string LengthText::with_unit(double length) const { return fmt::format("{} {}", plain(length), result_.units); }

std::string LengthText::with_sign_and_unit(double length) const {
  return fmt::format("{} {}", with_sign(length), result_.units);
}

std::string readable(std::string_view word) {
  std::string text(word);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace bladefit
