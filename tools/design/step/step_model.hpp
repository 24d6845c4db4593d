#pragma once
#include <Interface_Graph.hxx>
#include <StepData_StepModel.hxx>
#include <StepShape_FaceSurface.hxx>

#include <functional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace bladefit {

/// What the instances of a STEP file say of its faces beyond their shape.
class StepModel {
 public:
  StepModel(const Handle(StepData_StepModel) & model, const Interface_Graph& graph, const std::string& file);

  [[nodiscard]] const std::vector<Handle(StepShape_FaceSurface)>& faces() const { return faces_; }
  /// A face that stands in the shape of a representation, not loose in the file.
  [[nodiscard]] bool is_in_a_shape(const Standard_Transient* face) const { return in_shapes_.count(face) > 0; }
  [[nodiscard]] bool is_hidden(const Standard_Transient* face) const { return hidden_.count(face) > 0; }
  /// Name of the layer of a face; empty = none.
  [[nodiscard]] std::string layer_of(const Standard_Transient* face) const;
  /// "#17".
  [[nodiscard]] std::string label_of(const Handle(Standard_Transient) & entity) const;
  /// Its place in the file.
  [[nodiscard]] int place_of(const Handle(Standard_Transient) & entity) const;

  /// Throws ToolError where something that a face is made of is damaged, or is a B-spline surface that is none. An
  /// unset name is no damage.
  void check_faces() const;

 private:
  /// Calls `use` with every instance that `entity` is made of, itself included, once for all calls that share `seen`.
  void each_part(const Handle(Standard_Transient) & entity, std::unordered_set<const Standard_Transient*>& seen,
                 const std::function<void(const Handle(Standard_Transient) &)>& use) const;
  void check_readable(const Handle(Standard_Transient) & entity) const;
  void note_layers();
  void note_hidden();
  void note_shapes();

  Handle(StepData_StepModel) model_;
  std::string file_;
  Interface_Graph graph_;
  std::vector<Handle(StepShape_FaceSurface)> faces_;
  std::unordered_set<const Standard_Transient*> hidden_, in_shapes_;
  std::unordered_map<const Standard_Transient*, std::string> layers_;
};

}  // namespace bladefit
