#pragma once
#include <cstdint>

namespace bladefit {

/// What an image is made for. Feet are the same, and as well proven.
enum class ImageSize : std::uint8_t {
  fast,     ///< several leaves a span, so that most searches look at no pieces
  compact,  ///< one leaf a span: a third to a quarter of the bytes, searches some times slower
};

}  // namespace bladefit
