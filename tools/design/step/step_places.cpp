#include "tools/design/step/step_places.hpp"

#include <fmt/format.h>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_CartesianTransformationOperator3d.hxx>
#include <StepRepr_ItemDefinedTransformation.hxx>
#include <StepRepr_MappedItem.hxx>
#include <StepRepr_RepresentationMap.hxx>
#include <StepRepr_ShapeRepresentationRelationshipWithTransformation.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopLoc_Datum3D.hxx>

#include <cmath>

#include "tools/design/occ/affine_place.hpp"
#include "tools/design/step/step_operator.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// Operator k is a shift by this far along x and k times as far along z, in the file's unit.
constexpr double kShift = 1e18;
/// A shift farther than this [mm] is no part's own: files are in micrometres at the least.
constexpr double kFar_mm = 1e12;

bool is_axes(const Handle(Standard_Transient) & item) {
  return !item.IsNull() && item->IsKind(STANDARD_TYPE(StepGeom_Axis2Placement3d));
}

bool is_operator(const Handle(Standard_Transient) & item) {
  return !item.IsNull() && item->IsKind(STANDARD_TYPE(StepGeom_CartesianTransformationOperator3d));
}

/// How one representation stands in another is told by an operator or by two systems of axes.
bool is_readable(StepRepr_Transformation place) {
  const auto pair = Handle(StepRepr_ItemDefinedTransformation)::DownCast(place.Value());
  if (pair.IsNull()) return is_operator(place.Value());
  return is_axes(pair->TransformItem1()) && is_axes(pair->TransformItem2());
}

/// Axes that are those of the frame they stand in.
bool is_at_origin(const Handle(StepRepr_RepresentationItem) & item) {
  const auto axes = Handle(StepGeom_Axis2Placement3d)::DownCast(item);
  if (axes.IsNull() || axes->Location().IsNull()) return false;
  const auto along = [](const Handle(StepGeom_Direction) & direction, int axis) {
    bool is = direction->NbDirectionRatios() == 3;
    for (int k = 1; is && k <= 3; ++k) {
      const double ratio = direction->DirectionRatiosValue(k);
      is = k == axis ? ratio > 0 : ratio == 0;
    }
    return is;
  };
  for (int k = 1; k <= axes->Location()->NbCoordinates(); ++k) {
    if (axes->Location()->CoordinatesValue(k) != 0) return false;
  }
  return (!axes->HasAxis() || along(axes->Axis(), 3)) && (!axes->HasRefDirection() || along(axes->RefDirection(), 1));
}

/// Makes an operator a shift; its own axes and scale are gone.
void make_shift(StepGeom_CartesianTransformationOperator3d& operation, double times) {
  operation.UnSetAxis1();
  operation.UnSetAxis2();
  operation.UnSetAxis3();
  operation.UnSetScale();
  const Handle(StepGeom_CartesianPoint) origin = new StepGeom_CartesianPoint;
  origin->Init3D(new TCollection_HAsciiString(""), kShift, 0, times * kShift);
  operation.SetLocalOrigin(origin);
}

}  // namespace

StepPlaces::StepPlaces(const Handle(StepData_StepModel) & model, const std::string& file) : model_(model), file_(file) {
  check_items();
  take_operators();
}

void StepPlaces::check_items() const {
  constexpr const char* kUnread = "where a part stands is given in a way that is not read";
  for (int k = 1; k <= model_->NbEntities(); ++k) {
    const Handle(Standard_Transient)& entity = model_->Value(k);
    const auto related = Handle(StepRepr_ShapeRepresentationRelationshipWithTransformation)::DownCast(entity);
    if (!related.IsNull() && !is_readable(related->TransformationOperator())) refuse(label_of(entity), kUnread);
    const auto item = Handle(StepRepr_MappedItem)::DownCast(entity);
    if (item.IsNull() || item->MappingSource().IsNull()) continue;
    const Handle(StepRepr_Representation) part = item->MappingSource()->MappedRepresentation();
    if (part.IsNull() || !part->IsKind(STANDARD_TYPE(StepShape_ShapeRepresentation))) continue;
    const Handle(StepRepr_RepresentationItem) place = item->MappingTarget();
    if (!is_axes(place) && !is_operator(place)) refuse(label_of(entity), kUnread);
    if (is_operator(place) && !is_at_origin(item->MappingSource()->MappingOrigin())) {
      refuse(label_of(entity), "an operator places a part from axes that are not its own, which is not read");
    }
  }
}

void StepPlaces::take_operators() {
  for (int k = 1; k <= model_->NbEntities(); ++k) {
    const auto operation = Handle(StepGeom_CartesianTransformationOperator3d)::DownCast(model_->Value(k));
    if (operation.IsNull()) continue;
    const StepOperator found = step_operator(*operation);
    if (!found.fault.empty()) {
      refuse(label_of(operation), "where a part stands cannot be told of the operator: " + found.fault);
    }
    make_shift(*operation, static_cast<double>(operators_.size()));
    operators_.push_back(found.moves);
  }
}

std::string StepPlaces::label_of(const Handle(Standard_Transient) & entity) const {
  return fmt::format("#{}", model_->IdentLabel(entity));
}

void StepPlaces::refuse(const std::string& label, const std::string& what) const {
  throw ToolError(fmt::format("{}: {}: {}; export the blade as one part, not as an assembly", file_, label, what));
}

std::optional<Eigen::Affine3d> StepPlaces::meaning_of(const gp_Trsf& shift) const {
  const gp_XYZ& by = shift.TranslationPart();
  if (by.Modulus() < kFar_mm) return std::nullopt;
  const double times = by.Z() / by.X(), number = std::round(times);
  const bool plain = by.Y() == 0 && affine_of(shift).linear().isIdentity(0);
  if (!plain || std::abs(times - number) > 1e-6 || number < 0 || number >= static_cast<double>(operators_.size())) {
    refuse("an operator", "the CAD library does not place a part as it asks");
  }
  Eigen::Affine3d result = operators_[static_cast<std::size_t>(number)];
  result.translation() *= std::abs(by.X()) / kShift;
  return by.X() > 0 ? result : result.inverse();
}

std::optional<Eigen::Affine3d> StepPlaces::place_by_operators(TopLoc_Location location) const {
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  bool by_operators = false;
  for (; !location.IsIdentity(); location = location.NextLocation()) {
    const gp_Trsf& own = location.FirstDatum()->Transformation();
    const std::optional<Eigen::Affine3d> meant = meaning_of(own);
    by_operators = by_operators || meant;
    const Eigen::Affine3d step = meant.value_or(affine_of(own));
    for (int k = 0; k < std::abs(location.FirstPower()); ++k) {
      place = (location.FirstPower() > 0 ? step : step.inverse()) * place;
    }
  }
  return by_operators ? std::optional(place) : std::nullopt;
}

void StepPlaces::place(std::vector<CadFace>& faces) const {
  if (operators_.empty()) return;
  for (CadFace& face : faces) {
    const std::optional<Eigen::Affine3d> place = place_by_operators(face.face.Location());
    if (!place) continue;
    face.face.Location(TopLoc_Location());
    face.place = *place;
  }
}

}  // namespace bladefit
