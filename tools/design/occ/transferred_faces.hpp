#pragma once
#include <TopoDS_Shape.hxx>
#include <XSControl_WorkSession.hxx>

#include <unordered_map>

#include "tools/design/occ/cad_face.hpp"

namespace bladefit {

/// Which entity of the file a face was made from.
using FaceSources = std::unordered_map<const Standard_Transient*, Handle(Standard_Transient)>;

/// By the topological face that a transfer has made; it is shared where an assembly places a part several times.
[[nodiscard]] FaceSources face_sources(const Handle(XSControl_WorkSession) & session);

/// The faces of a shape, each with the side that its shells give it, and whether it belongs to an open or closed one.
/// Their entities are left to the caller, who finds them by key_of().
[[nodiscard]] std::vector<CadFace> faces_of(const TopoDS_Shape& shape);

/// The key of a face in FaceSources.
[[nodiscard]] inline const Standard_Transient* key_of(const TopoDS_Shape& face) { return face.TShape().get(); }

}  // namespace bladefit
