#include "config/outward_option.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace bladefit {

Failure parse_outward(std::string_view text, OutwardChoice& choice) {
  if (const auto word = std::ranges::find(kOutwardWords, text); word != kOutwardWords.end()) {
    choice = static_cast<OutwardOption>(word - kOutwardWords.begin());
    return {};
  }
  OutwardChoice list;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view entry = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), entry.size() + 1));
    const std::size_t colon = entry.rfind(':');
    const std::string_view side = colon == std::string_view::npos ? "" : entry.substr(colon + 1);
    if (colon == 0 || (side != "+" && side != "-")) {
      return bad_input(
          fmt::format("'{}' is not a side; say auto, +, - or a side for each face, for example SUCTION:+,3:-", entry));
    }
    list.faces.push_back({std::string(entry.substr(0, colon)), side == "+"});
  }
  if (list.faces.empty()) return bad_input("it is empty; say auto, +, - or a side for each face");
  choice = std::move(list);
  return {};
}

}  // namespace bladefit
