#pragma once
#include <TopoDS_Face.hxx>

namespace bladefit {

/// A rectangle of a surface's own parameters.
struct FaceBox {
  double u_min, u_max, v_min, v_max;
};

/// The box of a face's bounds. Sides within 1e-4 of the surface's range to its natural bounds, as approximated curves
/// are, lie on them.
[[nodiscard]] FaceBox face_box(const TopoDS_Face& face);

}  // namespace bladefit
