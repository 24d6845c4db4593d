#pragma once
#include <Geom_BSplineSurface.hxx>
#include <Geom_Surface.hxx>
#include <TopoDS_Face.hxx>

#include <string>
#include <vector>

#include "tools/design/nurbs/nurbs_surface.hpp"
#include "tools/design/occ/face_trim.hpp"

namespace bladefit {

/// A surface under a face and what it was turned into.
struct FaceBasis {
  Handle(Geom_Surface) surface;        ///< as the face's curves know it, before its placement
  FaceBox box;                         ///< of the face on it
  Handle(Geom_BSplineSurface) spline;  ///< the same surface, over `spline_box`; its parameters may run otherwise
  FaceBox spline_box;
  double scale = 1;  ///< of the placement
};

/// The trim loops of a face.
struct FaceLoops {
  std::vector<TrimLoop> loops;  ///< in the parameters of the box, 0..1; none where the face fills it
  double off_mm = 0;            ///< how far they were seen to be off the face's own curves
  std::string fault;            ///< why there are none although the face does not fill its box; empty: all is well
};

/// The bounds of a face as polygons in the parameters of its spline that are nowhere seen to be farther than
/// `tolerance_mm` from the curves. Curves that run along the sides of the box, as near as approximated curves are, lie
/// on them. Cost: some microseconds a vertex.
[[nodiscard]] FaceLoops face_loops(const TopoDS_Face& face, const FaceBasis& basis, double tolerance_mm);

}  // namespace bladefit
