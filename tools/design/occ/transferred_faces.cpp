#include "tools/design/occ/transferred_faces.hpp"

#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>

namespace bladefit {
namespace {

void append_faces(const TopoDS_Shape& shape, bool told, bool in_body, std::vector<CadFace>& faces) {
  CadFace face;
  face.told = told;
  face.in_body = in_body;
  for (TopExp_Explorer found(shape, TopAbs_FACE, told ? TopAbs_SHAPE : TopAbs_SHELL); found.More(); found.Next()) {
    face.face = TopoDS::Face(found.Current());
    faces.push_back(face);
  }
}

/// Takes the faces of an entity's shape where it is a face, or holds a single one.
void note_source(const TopoDS_Shape& shape, const Handle(Standard_Transient) & entity, FaceSources& sources) {
  TopExp_Explorer found(shape, TopAbs_FACE);
  if (!found.More()) return;
  const TopoDS_Shape face = found.Current();
  found.Next();
  if (!found.More()) sources.emplace(key_of(face), entity);
}

}  // namespace

FaceSources face_sources(const Handle(XSControl_WorkSession) & session) {
  FaceSources sources;
  const Handle(Transfer_TransientProcess) process = session->TransferReader()->TransientProcess();
  for (const bool single : {false, true}) {
    for (int k = 1; k <= process->NbMapped(); ++k) {
      const TopoDS_Shape shape = TransferBRep::ShapeResult(process, process->Mapped(k));
      if (!shape.IsNull() && single == (shape.ShapeType() != TopAbs_FACE)) {
        note_source(shape, process->Mapped(k), sources);
      }
    }
  }
  return sources;
}

std::vector<CadFace> faces_of(const TopoDS_Shape& shape) {
  std::vector<CadFace> faces;
  for (TopExp_Explorer found(shape, TopAbs_SHELL); found.More(); found.Next()) {
    append_faces(found.Current(), true, BRep_Tool::IsClosed(found.Current()), faces);
  }
  append_faces(shape, false, false, faces);
  return faces;
}

}  // namespace bladefit
