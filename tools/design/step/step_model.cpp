#include "tools/design/step/step_model.hpp"

#include <fmt/format.h>
#include <Interface_Check.hxx>
#include <Interface_EntityIterator.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <StepVisual_Invisibility.hxx>
#include <StepVisual_InvisibleItem.hxx>
#include <StepVisual_LayeredItem.hxx>
#include <StepVisual_PresentationLayerAssignment.hxx>
#include <StepVisual_StyledItem.hxx>
#include <TCollection_HAsciiString.hxx>

#include <string_view>

#include "tools/design/step/step_spline_check.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
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
