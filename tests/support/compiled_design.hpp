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

}  // namespace bladefit::testing
