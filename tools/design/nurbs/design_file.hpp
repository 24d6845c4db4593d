#pragma once
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/geometry/surface/design_image.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// What a user can tell one face of a design from the others by.
struct DesignFace {
  std::string entity;       ///< "face #17", "entity 144 at D5"
  std::string name;         ///< as the file has it; may be empty
  std::string layer;        ///< may be empty
  std::string kind;         ///< "B-spline", "plane", ...
  double area = 0;          ///< inside of its bounds [mm^2]
  double share = 1;         ///< of the box of its bounds in u and v that is inside of them
  double trims_off = 0;     ///< how far the trim loops are from the curves of the file [mm]
  std::string trims_fault;  ///< why a trimmed face is used up to the box of its bounds; empty = it is not
  bool told = false;        ///< the file says which side it looks to: it belongs to a shell
  bool in_body = false;     ///< the shell is closed: that side is away from the material
};

/// What a CAD file holds, checked and turned to mm.
struct DesignFile {
  std::vector<NurbsSurface> surfaces;  ///< at least one; patch k of the design is surfaces[k]
  std::vector<DesignFace> faces;       ///< of each surface, in the same order
  DesignUnit unit = DesignUnit::mm;    ///< in which lengths of this design are shown
  double file_unit_mm = 1;             ///< length of the unit that the file's numbers were in [mm]
  std::vector<std::string> warnings;   ///< one line each: what was repaired, converted or left out
  std::vector<std::string> missing;    ///< faces that could not be read, with kind and reason
};

}  // namespace bladefit
