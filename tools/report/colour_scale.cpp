#include "tools/report/colour_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace bladefit {
namespace {

using Colour = std::array<double, 3>;  // red, green, blue, 0..255

constexpr std::array<Colour, 5> kStops = {
    {{8, 64, 129}, {107, 174, 214}, {255, 255, 255}, {253, 174, 107}, {179, 71, 0}}};
constexpr double kDark = 0.6;  // of the way to a full colour
constexpr double kSmallest = 1e-9;

}  // namespace

std::string ColourScale::colour(double distance) const {
  const double place = 2.0 + 2.0 * std::clamp(distance / limit, -1.0, 1.0);  // along kStops, 0..4
  const auto stop = static_cast<std::size_t>(std::min(std::floor(place), 3.0));
  const double share = place - static_cast<double>(stop);
  const Colour &a = kStops.at(stop), &b = kStops.at(stop + 1);
  std::string text = "#";
  for (std::size_t k = 0; k < 3; ++k)
    text += fmt::format("{:02x}", static_cast<int>(std::lround(a.at(k) + share * (b.at(k) - a.at(k)))));
  return text;
}

bool ColourScale::is_dark(double distance) const { return std::abs(distance) > kDark * limit; }

ColourScale colour_scale_of(const Result& result) {
  double largest = 0.0, widest = 0.0;
  for (const ResultPoint& point : result.points) {
    if (point.state == PointState::rejected) continue;
    largest = std::max(largest, std::abs(result.in_units(point.distance)));
    widest = std::max(widest, result.in_units(point.tolerance));
  }
  return {widest <= largest ? std::max(widest, kSmallest) : round_step_above(std::max(largest, kSmallest))};
}

double round_step_above(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
    // The power of ten is rounded, so a value that is itself a step may lie a little above it.
    if (value <= factor * power * (1.0 + 1e-12)) return factor * power;
  }
  return 10.0 * power;
}

}  // namespace bladefit
