#pragma once
#include <cstddef>
#include <vector>

#include "core/geometry/surface/design_image.hpp"
#include "tools/design/image/trim_pieces.hpp"

namespace bladefit {

/// The arrays of an image while it is being put together.
struct ImageParts {
  std::vector<ImagePatch> patches;
  std::vector<ImageSpan> spans;
  std::vector<ImageLeaf> leaves;
  std::vector<ImageNode> nodes;
  std::vector<double> breaks, points, extractions, taylor;
  TrimParts trims;
};

/// Bytes of the image.
[[nodiscard]] std::uint64_t size_of(const ImageParts& parts);

/// The image, without a CRC. `box`: around all control points.
[[nodiscard]] std::vector<std::byte> assembled(const ImageParts& parts, DesignUnit unit, int outward, const Box& box);

}  // namespace bladefit
