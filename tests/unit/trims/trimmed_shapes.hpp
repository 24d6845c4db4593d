#pragma once
#include <TopoDS_Shape.hxx>

#include <string>
#include <vector>

namespace bladefit::testing {

/// A shape with trimmed faces, some 100 mm large.
struct TrimmedShape {
  std::string name;
  TopoDS_Shape shape;
  bool closed = false;  ///< a body: its sides are told
};

/// A plate with holes, a curved sheet with a hole and with slivers beside it, a lens-shaped blade on a hub with a root
/// fillet, the same with a trimmed tip, and a closed surface cut into two half faces.
[[nodiscard]] std::vector<TrimmedShape> trimmed_shapes();

}  // namespace bladefit::testing
