#include "config/zone_settings.hpp"

#include <fmt/format.h>

#include <utility>

#include "drivers/text/text_number.hpp"

namespace bladefit {
namespace {

constexpr std::string_view kBandWord = "r/R";

/// Cuts the first word off `rest`; empty where there is none.
std::string_view take_word(std::string_view& rest) {
  rest = trimmed(rest);
  const std::string_view word = rest.substr(0, rest.find(' '));
  rest.remove_prefix(word.size());
  return word;
}

Failure parse_band(std::string_view text, RadiusBand& band) {
  const std::size_t colon = text.find(':');
  const std::optional<double> low = parse_finite(text.substr(0, colon));
  const std::optional<double> high =
      colon == std::string_view::npos ? std::nullopt : parse_finite(text.substr(colon + 1));
  if (low && high && *low >= 0 && *low < *high && *high <= kLargestBand) {
    band = {*low, *high};
    return {};
  }
  return bad_input(fmt::format("'{} {}' is not a band; write r/R 0.7:1.0 with limits from 0 to {}, the lower first",
                               kBandWord, text, kLargestBand));
}

}  // namespace

Failure parse_zone_place(std::string_view text, ZonePlace& place) {
  ZonePlace read;
  for (std::string_view rest = text;;) {
    const std::string_view word = take_word(rest);
    if (word.empty()) break;
    if (word == kBandWord) {
      if (read.band) return bad_input("has two bands; give each its own zone");
      if (const Failure error = parse_band(take_word(rest), read.band.emplace())) return error;
    } else if (const Failure error = parse_edge_zone(word, read.edges.emplace_back())) {
      return error;
    }
  }
  if (read.edges.empty() && !read.band) {
    return bad_input(
        "names no place; write a leading edge as [PATCH:]u:0.4:0.6 or auto:5mm, or a band as r/R 0.7:1.0, or both");
  }
  place = std::move(read);
  return {};
}

}  // namespace bladefit
