#pragma once
#include <cstddef>
#include <vector>

#include "core/geometry/surface/design_image.hpp"
#include "tools/design/image/image_size.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// Compiles surfaces that check_surface has accepted into a design image: Bezier spans with their normal cones, the
/// bounding tree, header and CRC. `outward` is +1 or -1. The same surfaces give the same bytes. No span reaches
/// anywhere (mark_reach): that takes longer than what one fit gains. Throws ToolError where the design has too many
/// spans for the format.
std::vector<std::byte> write_image(const std::vector<NurbsSurface>& surfaces, DesignUnit unit, int outward,
                                   ImageSize size = ImageSize::fast);

/// Makes the CRC of an image right that has been changed.
void seal_image(std::vector<std::byte>& image);

/// An image that this program has just made, opened. Throws std::logic_error where it is not valid.
[[nodiscard]] DesignImage open_new_image(const std::vector<std::byte>& image);

/// Turns the outward side of a valid image to `outward` (+1 or -1), normal cones and CRC included.
void set_outward(std::vector<std::byte>& image, int outward);

}  // namespace bladefit
