#include "tools/design/step/step_model.hpp"

#include <fmt/format.h>
#include <Interface_Check.hxx>
#include <Interface_EntityIterator.hxx>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_CartesianTransformationOperator3d.hxx>
#include <StepGeom_Direction.hxx>
#include <StepRepr_MappedItem.hxx>
#include <StepRepr_RepresentationMap.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <StepVisual_Invisibility.hxx>
#include <StepVisual_InvisibleItem.hxx>
#include <StepVisual_LayeredItem.hxx>
#include <StepVisual_PresentationLayerAssignment.hxx>
#include <StepVisual_StyledItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <gp_Vec.hxx>

#include <string_view>

#include "tools/design/step/step_spline_check.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

gp_Vec direction_or(const Handle(StepGeom_Direction) & given, const gp_Vec& otherwise) {
  if (given.IsNull() || given->NbDirectionRatios() != 3) return otherwise;
  return {given->DirectionRatiosValue(1), given->DirectionRatiosValue(2), given->DirectionRatiosValue(3)};
}

/// What OpenCASCADE makes of a placement without a word: it leaves a scale out, and takes a mirror for a turn.
std::string place_fault(const StepGeom_CartesianTransformationOperator3d& place) {
  if (place.HasScale() && place.Scale() != 1) return fmt::format("made {:g} times as large", place.Scale());
  const gp_Vec x = direction_or(place.Axis1(), {1, 0, 0}), y = direction_or(place.Axis2(), {0, 1, 0});
  return x.Crossed(y).Dot(direction_or(place.Axis3(), x.Crossed(y))) < 0 ? "mirrored" : "";
}

}  // namespace

StepModel::StepModel(const Handle(StepData_StepModel) & model, const Interface_Graph& graph, const std::string& file)
    : model_(model), file_(file), graph_(graph) {
  for (int k = 1; k <= model_->NbEntities(); ++k) {
    const auto face = Handle(StepShape_FaceSurface)::DownCast(model_->Value(k));
    if (!face.IsNull()) faces_.push_back(face);
  }
  note_layers();
  note_hidden();
  note_shapes();
}

std::string StepModel::layer_of(const Standard_Transient* face) const {
  const auto found = layers_.find(face);
  return found == layers_.end() ? std::string() : found->second;
}

int StepModel::place_of(const Handle(Standard_Transient) & entity) const { return model_->Number(entity); }

std::string StepModel::label_of(const Handle(Standard_Transient) & entity) const {
  return fmt::format("#{}", model_->IdentLabel(entity));
}

void StepModel::check_faces() const {
  std::unordered_set<const Standard_Transient*> seen;
  for (const Handle(StepShape_FaceSurface) & face : faces_) {
    each_part(face, seen, [this](const Handle(Standard_Transient) & part) {
      check_readable(part);
      const auto spline = Handle(StepGeom_BSplineSurface)::DownCast(part);
      const std::string fault = spline.IsNull() ? std::string() : spline_fault(*spline);
      if (fault.empty()) return;
      throw ToolError(fmt::format("{}: surface {}: {}; export the design again", file_, label_of(part), fault));
    });
  }
}

void StepModel::check_places() const {
  for (int k = 1; k <= model_->NbEntities(); ++k) {
    const Handle(Standard_Transient)& entity = model_->Value(k);
    const auto operation = Handle(StepGeom_CartesianTransformationOperator3d)::DownCast(entity);
    const std::string fault = operation.IsNull() ? std::string() : place_fault(*operation);
    if (!fault.empty()) {
      throw ToolError(
          fmt::format("{}: {}: a part is {} where it is placed, which is not read; export the blade as one "
                      "part, not as an assembly",
                      file_, label_of(entity), fault));
    }
    const auto item = Handle(StepRepr_MappedItem)::DownCast(entity);
    if (item.IsNull() || item->MappingSource().IsNull()) continue;
    const Handle(StepRepr_Representation) part = item->MappingSource()->MappedRepresentation();
    const Handle(StepRepr_RepresentationItem) place = item->MappingTarget();
    const bool known = !place.IsNull() && (place->IsKind(STANDARD_TYPE(StepGeom_Axis2Placement3d)) ||
                                           place->IsKind(STANDARD_TYPE(StepGeom_CartesianTransformationOperator3d)));
    if (known || part.IsNull() || !part->IsKind(STANDARD_TYPE(StepShape_ShapeRepresentation))) continue;
    throw ToolError(
        fmt::format("{}: {}: where a part stands is given in a way that is not read; export the blade as one "
                    "part, not as an assembly",
                    file_, label_of(entity)));
  }
}

void StepModel::each_part(const Handle(Standard_Transient) & entity,
                          std::unordered_set<const Standard_Transient*>& seen,
                          const std::function<void(const Handle(Standard_Transient) &)>& use) const {
  std::vector<Handle(Standard_Transient)> pending = {entity};
  while (!pending.empty()) {
    const Handle(Standard_Transient) part = pending.back();
    pending.pop_back();
    if (!seen.insert(part.get()).second) continue;
    use(part);
    for (Interface_EntityIterator parts = graph_.Shareds(part); parts.More(); parts.Next())
      pending.push_back(parts.Value());
  }
}

void StepModel::check_readable(const Handle(Standard_Transient) & entity) const {
  const int index = model_->Number(entity);
  if (!model_->IsErrorEntity(index)) return;
  const Handle(Interface_Check)& check = model_->Check(index, Standard_True);
  const int fails = check.IsNull() ? 0 : check->NbFails();
  bool damaged = fails == 0;
  std::string reason = "damaged record";
  for (int k = 1; k <= fails; ++k) {
    const std::string_view fail = check->CFail(k);
    if (fail.find("(name)") != std::string_view::npos) continue;
    if (!damaged) reason = fail;
    damaged = true;
  }
  if (!damaged) return;
  throw ToolError(fmt::format("{}: {} ({}): {}; export the design again", file_, label_of(entity),
                              model_->TypeName(entity, Standard_False), reason));
}

void StepModel::note_layers() {
  for (int k = 1; k <= model_->NbEntities(); ++k) {
    const auto layer = Handle(StepVisual_PresentationLayerAssignment)::DownCast(model_->Value(k));
    if (layer.IsNull() || layer->Name().IsNull() || layer->AssignedItems().IsNull()) continue;
    std::unordered_set<const Standard_Transient*> seen;
    for (int item = 1; item <= layer->NbAssignedItems(); ++item) {
      each_part(layer->AssignedItemsValue(item).Value(), seen, [&](const Handle(Standard_Transient) & part) {
        if (part->IsKind(STANDARD_TYPE(StepShape_FaceSurface))) layers_.emplace(part.get(), layer->Name()->ToCString());
      });
    }
  }
}

void StepModel::note_shapes() {
  std::unordered_set<const Standard_Transient*> seen;
  for (int k = 1; k <= model_->NbEntities(); ++k) {
    const Handle(Standard_Transient)& entity = model_->Value(k);
    if (!entity->IsKind(STANDARD_TYPE(StepShape_ShapeRepresentation))) continue;
    each_part(entity, seen, [this](const Handle(Standard_Transient) & part) {
      if (part->IsKind(STANDARD_TYPE(StepShape_FaceSurface))) in_shapes_.insert(part.get());
    });
  }
}

void StepModel::note_hidden() {
  std::unordered_set<const Standard_Transient*> seen;
  for (int k = 1; k <= model_->NbEntities(); ++k) {
    const auto invisibility = Handle(StepVisual_Invisibility)::DownCast(model_->Value(k));
    if (invisibility.IsNull() || invisibility->InvisibleItems().IsNull()) continue;
    for (int item = 1; item <= invisibility->NbInvisibleItems(); ++item) {
      each_part(invisibility->InvisibleItemsValue(item).Value(), seen, [this](const Handle(Standard_Transient) & part) {
        if (part->IsKind(STANDARD_TYPE(StepShape_FaceSurface))) hidden_.insert(part.get());
      });
    }
  }
}

}  // namespace bladefit
