#pragma once
#include <string>
#include <string_view>

namespace bladefit {

/// A text in quotation marks, with what may not stand between them escaped (RFC 8259, section 7).
[[nodiscard]] std::string json_text(std::string_view text);

/// A number to seven digits; null where it is not finite.
[[nodiscard]] std::string json_number(double value);

/// "[a,b,c]" of texts of JSON.
template <class Items, class TextOf>
[[nodiscard]] std::string json_list(const Items& items, TextOf text_of) {
  std::string list = "[";
  for (const auto& item : items) {
    if (list.size() > 1) list += ',';
    list += text_of(item);
  }
  return list + "]";
}

}  // namespace bladefit
