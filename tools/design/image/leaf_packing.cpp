#include "tools/design/image/leaf_packing.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace bladefit {
namespace {

/// Axes are shorter than 1 by this share. Nine numbers rounded to single precision, by 3e-8 each, turn and stretch a
/// vector by less than 1e-7 of it.
constexpr double kShorter = 4e-7;
/// Of a vector: more than it can differ in axes that are shorter and rounded.
constexpr double kAxesRounding = 1e-6;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

HalfFloat below(double x) {
  float single = static_cast<float>(x);
  if (static_cast<double>(single) > x) single = std::nextafter(single, -kInfinity);
  const auto bits = std::bit_cast<std::uint32_t>(single);
  // Leaving digits out takes a number towards zero.
  const bool away = single < 0.0F && (bits & 0xFFFFU) != 0;
  return static_cast<HalfFloat>((bits >> 16U) + (away ? 1U : 0U));
}

HalfFloat above(double x) {
  const HalfFloat negative = below(-x);
  return static_cast<HalfFloat>(negative ^ 0x8000U);
}

}  // namespace

ImageBounds packed(const LeafBounds& bounds) {
  ImageBounds out{};
  double size = 0.0;
  for (int k = 0; k < 3; ++k) size += std::max(std::abs(bounds.low[k]), std::abs(bounds.high[k]));
  for (int k = 0; k < 3; ++k) {
    out.middle[k] = static_cast<float>(bounds.middle[k]);
    out.stretch[k] = static_cast<float>(bounds.stretch[k]);
    for (int j = 0; j < 3; ++j) out.axis[k][j] = static_cast<float>((1.0 - kShorter) * bounds.axis[k][j]);
    out.low[k] = below(bounds.low[k] - kAxesRounding * size);
    out.high[k] = above(bounds.high[k] + kAxesRounding * size);
  }
  for (std::size_t d = 0; d < kDerivatives; ++d) {
    double length = 0.0;
    for (int k = 0; k < 3; ++k) length += std::abs(bounds.derivative[d][k]) + bounds.spread[d][k];
    for (int k = 0; k < 3; ++k) {
      out.derivative[d][k] = static_cast<float>(bounds.derivative[d][k]);
      const double off = std::abs(static_cast<double>(out.derivative[d][k]) - bounds.derivative[d][k]);
      out.spread[d][k] = above(bounds.spread[d][k] + off + kAxesRounding * length);
    }
    out.self_low[d] = below(bounds.self_low[d]);
    out.self_high[d] = above(bounds.self_high[d]);
  }
  return out;
}

}  // namespace bladefit
