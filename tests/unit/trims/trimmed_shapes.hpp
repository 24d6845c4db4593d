#pragma once
#include <TopoDS_Shape.hxx>

#include <cstddef>
#include <string>

namespace bladefit::testing {

/// A shape with trimmed faces, some 100 mm large.
struct TrimmedShape {
  std::string name;
  TopoDS_Shape shape;
  bool closed = false;  ///< a body: its sides are told
};

/// By number: a plate with holes, a curved sheet with a hole, slivers on it, a closed surface cut into two half faces,
/// a lens-shaped blade with a trimmed tip, one on a hub with a root fillet, and a ball, with poles, that a bore cuts.
inline constexpr std::size_t kTrimmedShapes = 7;
[[nodiscard]] TrimmedShape trimmed_shape(std::size_t index);

/// A body of `blades` blades like the last about the x axis, the first along +z, fused with a hub, in which there are a
/// bore and a keyway.
[[nodiscard]] TopoDS_Shape propeller_body(int blades);

}  // namespace bladefit::testing
