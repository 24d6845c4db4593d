#pragma once
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/geometry/surface/design_image.hpp"
#include "core/geometry/surface/surface.hpp"

namespace bladefit::testing {

/// A design image with the memory it stands in.
class CompiledDesign {
 public:
  explicit CompiledDesign(std::vector<std::byte> bytes)
      : bytes_(std::move(bytes)), image_(opened(bytes_)), surface_(image_) {}
  CompiledDesign(const CompiledDesign&) = delete;
  CompiledDesign& operator=(const CompiledDesign&) = delete;

  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }
  [[nodiscard]] const DesignImage& image() const { return image_; }
  [[nodiscard]] const Surface& surface() const { return surface_; }
  [[nodiscard]] double size() const { return surface_.half_diagonal(); }

 private:
  static DesignImage opened(const std::vector<std::byte>& bytes) {
    DesignImage image;
    const Status status = DesignImage::open(bytes, image);
    if (status != Status::ok) throw std::runtime_error(status_text(status));
    return image;
  }

  std::vector<std::byte> bytes_;
  DesignImage image_;
  Surface surface_;
};

/// The same design with nothing known of how far its spans reach: every foot is proven by a search.
inline CompiledDesign without_reach(const CompiledDesign& design) {
  std::vector<std::byte> bytes = design.bytes();
  auto* const header = reinterpret_cast<ImageHeader*>(bytes.data());
  auto* const spans = reinterpret_cast<ImageSpan*>(bytes.data() + header->spans_offset);
  for (std::uint32_t k = 0; k < header->span_count; ++k) spans[k].reach[0] = spans[k].reach[1] = spans[k].apart = 0.0F;
  header->crc32 = image_crc(bytes);
  return CompiledDesign(std::move(bytes));
}

}  // namespace bladefit::testing
