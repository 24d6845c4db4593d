#pragma once
#include <StepData_StepModel.hxx>
#include <TopLoc_Location.hxx>
#include <gp_Trsf.hxx>

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "tools/design/occ/cad_face.hpp"

namespace bladefit {

/// Where the transformation operators of a STEP file put its parts. OpenCASCADE leaves their scale out and may take a
/// mirror for a turn. So while it reads, each is a shift farther than any file's, and place() puts in its stead what it
/// means, wherever it stands in the places of a face.
class StepPlaces {
 public:
  /// Turns the operators of `model` into shifts. Throws ToolError where one cannot be told, or where a part is placed
  /// by what OpenCASCADE does not know and leaves out.
  StepPlaces(const Handle(StepData_StepModel) & model, const std::string& file);

  /// Moves each face that an operator places to its own frame, with CadFace::place to where it stands. Throws ToolError
  /// where OpenCASCADE has merged a shift with something else.
  void place(std::vector<CadFace>& faces) const;

 private:
  void take_operators();
  void check_items() const;
  [[nodiscard]] std::string label_of(const Handle(Standard_Transient) & entity) const;
  [[noreturn]] void refuse(const std::string& label, const std::string& what) const;
  [[nodiscard]] std::optional<Eigen::Affine3d> meaning_of(const gp_Trsf& shift) const;
  [[nodiscard]] std::optional<Eigen::Affine3d> place_by_operators(TopLoc_Location location) const;

  Handle(StepData_StepModel) model_;
  std::string file_;
  std::vector<Eigen::Affine3d> operators_;  ///< in the file's unit
};

}  // namespace bladefit
