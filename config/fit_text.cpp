#include "config/fit_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "drivers/text/text_number.hpp"
#include "drivers/text/units.hpp"

namespace bladefit {
namespace {

/// Cuts the text up to the next colon off `rest`.
std::string_view take_part(std::string_view& rest) {
  const std::size_t colon = rest.find(':');
  const std::string_view part = rest.substr(0, colon);
  rest.remove_prefix(colon == std::string_view::npos ? rest.size() : colon + 1);
  return part;
}

/// Reads `a:b`, 0 <= a < b <= 1. False: it is not that.
bool parse_interval(std::string_view text, double& low, double& high) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return false;
  const std::optional<double> first = parse_finite(text.substr(0, colon));
  const std::optional<double> second = parse_finite(text.substr(colon + 1));
  if (!first || !second || !(*first >= 0 && *first < *second && *second <= 1)) return false;
  low = *first;
  high = *second;
  return true;
}

}  // namespace

Failure parse_lock(std::string_view text, std::uint8_t& locked) {
  std::uint32_t read = 0;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t comma = rest.find(',');
    const std::string_view name = trimmed(rest.substr(0, comma));
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
    const auto* known = std::find(kDegreesOfFreedom.begin(), kDegreesOfFreedom.end(), name);
    if (known == kDegreesOfFreedom.end()) {
      return bad_input(fmt::format(
          "'{}' is not a degree of freedom; write some of tx,ty,tz,rx,ry,rz with commas between them", name));
    }
    read |= 1U << static_cast<unsigned>(known - kDegreesOfFreedom.begin());
  }
  if (read == 63U) return bad_input("all six degrees of freedom are locked; leave one free for the fit");
  locked = static_cast<std::uint8_t>(read);
  return {};
}

Failure parse_leading_edge(std::string_view text, ParameterBox& box) {
  const Failure wrong = bad_input(fmt::format(
      "'{}' is not a leading-edge box; write [PATCH:]u:0.4:0.6 or [PATCH:]v:0.4:0.6 with limits from 0 to 1, "
      "the lower first, or auto:5mm, auto:3%",
      text));
  std::string_view rest = text;
  ParameterBox read;
  std::string_view part = take_part(rest);
  if (part != "u" && part != "v") {
    const std::optional<std::uint32_t> patch = parse_whole<std::uint32_t>(part);
    if (!patch) return wrong;
    read.patch = *patch;
    part = take_part(rest);
  }
  if (part != "u" && part != "v") return wrong;
  const bool along_u = part == "u";
  if (!parse_interval(rest, along_u ? read.u_min : read.v_min, along_u ? read.u_max : read.v_max)) return wrong;
  box = read;
  return {};
}

Failure parse_edge_zone(std::string_view text, EdgeZone& zone) {
  constexpr std::string_view kAuto = "auto:";
  EdgeZone read;
  if (!text.starts_with(kAuto)) {
    if (const Failure error = parse_leading_edge(text, read.box)) return error;
    zone = read;
    return {};
  }
  const Failure wrong = bad_input(fmt::format(
      "'{}' is not a zone; write auto: with a length above 0 and its unit, auto:5mm or auto:0.2in, or with a "
      "share of the chord below 50 %, auto:3%",
      text));
  const std::string_view amount = text.substr(kAuto.size());
  const std::size_t end = std::min(amount.find_first_not_of("0123456789.eE+-"), amount.size());
  const std::optional<double> number = parse_finite(amount.substr(0, end));
  const std::string_view unit = amount.substr(end);
  if (!number || !(*number > 0) || *number > 1e9) return wrong;
  read.reach = *number;
  read.percent = unit == "%";
  if (read.percent && *number >= 50) return wrong;
  if (!read.percent) {
    const auto* const known = std::ranges::find(kUnitWords, unit);
    if (known == kUnitWords.end()) return wrong;
    read.reach *= mm_per_unit(static_cast<Unit>(known - kUnitWords.begin()));
  }
  zone = read;
  return {};
}

Failure parse_place(std::string_view text, Vec3& place) {
  Vec3 read;
  std::string_view rest = text;
  for (int k = 0; k < 3; ++k) {
    const std::size_t comma = rest.find(',');
    const std::optional<double> number = parse_finite(trimmed(rest.substr(0, comma)));
    if (!number || (comma == std::string_view::npos) != (k == 2))
      return bad_input(fmt::format("'{}' is not a place; write x,y,z: three numbers with commas between them", text));
    read[k] = *number;
    rest.remove_prefix(k == 2 ? rest.size() : comma + 1);
  }
  place = read;
  return {};
}

Failure parse_mpe(std::string_view text, ProbeError& error) {
  const Failure wrong =
      bad_input(fmt::format("'{}' is not a largest permissible error; write A+L/K, for example 1.9+L/300: A in "
                            "micrometres, L in mm, each above 0",
                            text));
  const std::size_t plus = text.find('+');
  const std::optional<double> constant = parse_finite(trimmed(text.substr(0, plus)));
  if (!constant || !(*constant > 0)) return wrong;
  ProbeError read{*constant, 0};
  if (plus != std::string_view::npos) {
    const std::string_view growing = trimmed(text.substr(plus + 1));
    const std::size_t slash = growing.find('/');
    if (slash == std::string_view::npos || trimmed(growing.substr(0, slash)) != "L") return wrong;
    const std::optional<double> divisor = parse_finite(trimmed(growing.substr(slash + 1)));
    if (!divisor || !(*divisor > 0)) return wrong;
    read.length_mm_per_um = *divisor;
  }
  error = read;
  return {};
}

Failure parse_window(std::string_view text, ParameterWindow& window) {
  if (parse_interval(text, window.low, window.high)) return {};
  return bad_input(fmt::format("'{}' is not a window; write 0.05:0.95, limits from 0 to 1, the lower first", text));
}

Failure parse_axis(std::string_view text, ShaftAxis& axis) {
  constexpr std::string_view kNames = "xyz";
  if (text.size() == 1 && kNames.find(text[0]) != std::string_view::npos) {
    axis = {Vec3::Zero(), Vec3::Unit(static_cast<Eigen::Index>(kNames.find(text[0])))};
    return {};
  }
  const Failure wrong = bad_input(fmt::format(
      "'{}' is not an axis; write x, y, z, or six numbers x0,y0,z0,i,j,k: a point of it and its direction", text));
  Vec6 numbers;
  std::string_view rest = text;
  for (int k = 0; k < 6; ++k) {
    const std::size_t comma = rest.find(',');
    if ((comma == std::string_view::npos) != (k == 5)) return wrong;
    const std::optional<double> number = parse_finite(trimmed(rest.substr(0, comma)));
    if (!number) return wrong;
    numbers[k] = *number;
    rest.remove_prefix(k == 5 ? rest.size() : comma + 1);
  }
  const double length = numbers.tail<3>().norm();
  if (!(length > 0.0) || !std::isfinite(length))
    return bad_input(fmt::format("'{}' has no direction; i,j,k must not all be 0", text));
  axis = {numbers.head<3>(), numbers.tail<3>() / length};
  return {};
}

}  // namespace bladefit
