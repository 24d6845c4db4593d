#include "drivers/text/units.hpp"

#include <fmt/format.h>

#include <string>

#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

/// The spellings of each unit, with a bar before and behind each.
constexpr std::array<std::string_view, kUnitWords.size()> kSpellings = {
    "|mm|millimeter|millimetre|millimeters|millimetres|", "|in|inch|inches|\"|''|",
    "|cm|centimeter|centimetre|centimeters|centimetres|", "|m|meter|metre|meters|metres|"};

}  // namespace

std::optional<Unit> parse_unit(std::string_view text) {
  text = trimmed(text);
  if (text.ends_with('.')) text.remove_suffix(1);
  if (text.empty() || text.find('|') != std::string_view::npos) return std::nullopt;
  const std::string word = fmt::format("|{}|", text);
  for (std::size_t unit = 0; unit < kSpellings.size(); ++unit) {
    if (kSpellings[unit].find(word) != std::string_view::npos) return static_cast<Unit>(unit);
  }
  return std::nullopt;
}

}  // namespace bladefit
