#include "tools/design/step/step_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace bladefit {
namespace {

constexpr std::array<std::string_view, 17> kPrefixes = {"$",       ".EXA.",   ".PETA.", ".TERA.",  ".GIGA.",  ".MEGA.",
                                                        ".KILO.",  ".HECTO.", ".DECA.", ".DECI.",  ".CENTI.", ".MILLI.",
                                                        ".MICRO.", ".NANO.",  ".PICO.", ".FEMTO.", ".ATTO."};

constexpr std::array<std::string_view, 28> kNames = {
    ".METRE.",          ".GRAM.",      ".SECOND.",  ".AMPERE.", ".KELVIN.", ".MOLE.",  ".CANDELA.", ".RADIAN.",
    ".STERADIAN.",      ".HERTZ.",     ".NEWTON.",  ".PASCAL.", ".JOULE.",  ".WATT.",  ".COULOMB.", ".VOLT.",
    ".FARAD.",          ".OHM.",       ".SIEMENS.", ".WEBER.",  ".TESLA.",  ".HENRY.", ".LUMEN.",   ".LUX.",
    ".DEGREE_CELSIUS.", ".BECQUEREL.", ".GRAY.",    ".SIEVERT."};
constexpr std::size_t kShownOfUnit = 40;
/// Bytes behind a word, so that the cost of a text stays linear.
constexpr std::size_t kLookedAt = 4096;

/// Numbers between a `(` and the next parenthesis, with commas between them; 0 where something else stands there.
std::size_t numbers_in_list(std::string_view list) {
  constexpr std::string_view kOfNumbers = "0123456789.+-eE, \t\r\n";
  const std::size_t end = list.find_first_not_of(kOfNumbers);
  if (end == std::string_view::npos || list[end] != ')' || end == 0) return 0;
  return 1 + static_cast<std::size_t>(std::ranges::count(list.substr(0, end), ','));
}

/// The first list of numbers among the parameters: behind a `(` that no text or comment holds.
std::size_t numbers_of(std::string_view rest) {
  for (std::size_t place = 0; place < rest.size() && rest[place] != ';'; ++place) {
    if (rest[place] == '\'') {
      place = std::min(rest.find('\'', place + 1), rest.size());
    } else if (rest[place] == '(') {
      if (const std::size_t numbers = numbers_in_list(rest.substr(place + 1)); numbers > 0) return numbers;
    }
  }
  return 0;
}

std::string closed_up(std::string_view text) {
  std::string out;
  std::ranges::copy_if(text, std::back_inserter(out), [](char c) { return c > ' '; });
  return out;
}

/// "(.MILLI.,.METRE.)", or "(*,.MILLI.,.METRE.)" where the unit is an entity of its own.
std::string unit_fault(std::string_view rest) {
  std::string list = closed_up(rest.substr(0, std::min(rest.find(')'), rest.size())));
  if (!list.starts_with('(')) return "";
  list.erase(0, list.starts_with("(*,") ? 3 : 1);
  const std::size_t comma = std::min(list.find(','), list.size());
  const std::string prefix = list.substr(0, comma), name = list.substr(std::min(comma + 1, list.size()));
  const auto none_of = [](const auto& words, const std::string& word) {
    return std::ranges::find(words, word) == words.end();
  };
  if (none_of(kPrefixes, prefix)) return fmt::format("'{}' is not a prefix of a unit", prefix.substr(0, kShownOfUnit));
  return none_of(kNames, name) ? fmt::format("'{}' is not a unit", name.substr(0, kShownOfUnit)) : "";
}

}  // namespace

std::string step_word_fault(std::string_view word, std::string_view rest) {
  rest = rest.substr(0, kLookedAt);
  if (word == "CARTESIAN_POINT" || word == "DIRECTION") {
    const std::size_t numbers = numbers_of(rest);
    if (numbers > 3) return fmt::format("{} has {} numbers where 3 belong; is it a decimal comma?", word, numbers);
  }
  if (word.ends_with("_MEASURE") && rest.starts_with('(')) {
    const std::size_t numbers = numbers_in_list(rest.substr(1));
    if (numbers > 1) return fmt::format("{} has {} numbers where 1 belongs; is it a decimal comma?", word, numbers);
  }
  return word == "SI_UNIT" ? unit_fault(rest) : "";
}

}  // namespace bladefit
