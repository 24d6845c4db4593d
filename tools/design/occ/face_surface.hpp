#pragma once
#include <string>

#include "tools/design/nurbs/nurbs_surface.hpp"
#include "tools/design/occ/cad_face.hpp"

namespace bladefit {

/// What a face is as a NURBS surface.
struct FaceSurface {
  NurbsSurface surface;     ///< [mm]; over the box of the face's bounds, which is all of it for most blades
  std::string kind;         ///< of the surface in the file: "B-spline", "plane", "cylinder" ...
  double area = 0;          ///< of the face [mm^2]
  double share = 1;         ///< of the box's area that is inside of the face's bounds
  double approximated = 0;  ///< how far the surface is from that of the file [mm]; 0 = exact
  double trims_off = 0;     ///< how far the trim loops are from the curves of the file [mm]; 0 = none, or exact
  std::string trims_fault;  ///< why a trimmed face has no loops, and is used whole; empty = all is well
};

/// "B-spline", "plane", ... ; what the surface under a face is.
[[nodiscard]] std::string kind_of(const CadFace& face);

/// The surface of a face, moved to its place. B-splines are taken as they are, cut at the box of the face's bounds by
/// knot insertion; planes, cylinders, cones, spheres, tori, extrusions, revolutions and Bezier surfaces are turned into
/// B-splines exactly; offsets, degrees over 9 and bounds that are no sides of the box within `tolerance_mm`.
/// To be called within with_cad_library(). Throws ToolError, or what OpenCASCADE throws, where that cannot be done.
[[nodiscard]] FaceSurface face_surface(const CadFace& face, double tolerance_mm);

}  // namespace bladefit
