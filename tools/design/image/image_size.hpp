#pragma once
#include <cstdint>

namespace bladefit {

/// What an image is made for. Feet are the same, and as well proven. An image is no larger than so many times its
/// control points, 32 bytes each, unless its trim loops alone are.
enum class ImageSize : std::uint8_t {
  fast,     ///< 40 times: Taylor forms, and leaves so small that most searches look at no pieces
  compact,  ///< 20 times: one leaf a span, Taylor forms worked out each time; a fit is some times slower
};

}  // namespace bladefit
