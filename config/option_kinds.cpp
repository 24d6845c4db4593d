#include "config/option_kinds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "config/fit_text.hpp"
#include "drivers/replay/points_csv.hpp"

namespace bladefit {

Failure set(const NumberOption& option, double given, FitSettings& settings) {
  const bool inside = given >= option.low && given <= option.high && !(option.above && given == option.low);
  if (inside) {
    settings.*option.value = given;
    return {};
  }
  if (option.above)
    return bad_input(fmt::format("{} is out of range; give one above {}, up to {}", given, option.low, option.high));
  return bad_input(fmt::format("{} is out of range; give a number from {} to {}", given, option.low, option.high));
}

Failure set(const LengthOption& option, const Length& given, FitSettings& settings) {
  if (given.value <= kLargestGiven && (given.value > 0 || (given.value == 0 && !option.above))) {
    settings.*option.value = given;
    return {};
  }
  if (option.above)
    return bad_input(fmt::format("{} is out of range; give one above 0, up to {}", given.value, kLargestGiven));
  return bad_input(fmt::format("{} is out of range; give 0 or more, up to {}", given.value, kLargestGiven));
}

Failure find_word(std::span<const std::string_view> words, std::string_view text, std::size_t& place) {
  const auto found = std::ranges::find(words, text);
  if (found == words.end()) return bad_input(fmt::format("'{}' is none of: {}", text, fmt::join(words, ", ")));
  place = static_cast<std::size_t>(found - words.begin());
  return {};
}

Failure set(const ZonesOption& option, const std::vector<std::string>& given, FitSettings& settings) {
  if (given.size() > ToleranceMap::kMaxBoxes)
    return bad_input(fmt::format("{} zones, at most {} are possible", given.size(), ToleranceMap::kMaxBoxes));
  std::vector<EdgeZone> zones(given.size());
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (const Failure error = parse_edge_zone(given[k], zones[k])) return error;
  }
  settings.*option.value = std::move(zones);
  return {};
}

Failure set(const PlaceOption& option, const std::string& given, FitSettings& settings) {
  Vec3 place;
  if (const Failure error = parse_place(given, place)) return error;
  settings.*option.value = place;
  return {};
}

Failure set(const OutwardKind& option, const std::string& given, FitSettings& settings) {
  OutwardChoice choice;
  if (const Failure error = parse_outward(given, choice)) return error;
  settings.*option.value = std::move(choice);
  return {};
}

Failure set(const NamesOption& option, const std::vector<std::string>& given, FitSettings& settings) {
  settings.*option.value = given;
  return {};
}

Failure set(const WindowOption& option, const std::string& given, FitSettings& settings) {
  ParameterWindow window;
  if (const Failure error = parse_window(given, window)) return error;
  settings.*option.value = window;
  return {};
}

Failure set(const LocksOption& option, const std::string& given, FitSettings& settings) {
  std::uint8_t locked = 0;
  if (const Failure error = parse_lock(given, locked)) return error;
  settings.*option.value = locked;
  return {};
}

Failure set(const MpeOption& option, const std::string& given, FitSettings& settings) {
  ProbeError error;
  if (const Failure failure = parse_mpe(given, error)) return failure;
  settings.*option.value = error;
  return {};
}

Failure set(const AxisOption& option, const std::string& given, FitSettings& settings) {
  ShaftAxis axis;
  if (const Failure error = parse_axis(given, axis)) return error;
  settings.*option.value = axis;
  return {};
}

Failure set(const PathOption& option, const std::string& given, FitSettings& settings) {
  settings.*option.value = given;
  return {};
}

Failure set(const ColumnsOption& option, const std::string& given, FitSettings& settings) {
  if (const Failure error = check_point_columns(given)) return error;
  settings.*option.value = given;
  return {};
}

Failure set(const FlagOption& option, bool given, FitSettings& settings) {
  settings.*option.value = given;
  return {};
}

}  // namespace bladefit
