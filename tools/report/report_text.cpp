#include "tools/report/report_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace bladefit {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
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
