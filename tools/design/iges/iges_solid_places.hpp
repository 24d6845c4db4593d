#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "tools/design/iges/iges_clean.hpp"
#include "tools/design/occ/cad_face.hpp"

namespace bladefit {

/// Where the matrices (124) of solids (186), of their shells (514) and of their faces (510) put the faces: OpenCASCADE
/// leaves them out, where it does heed those of surfaces, trimmed surfaces, groups and instances.
class IgesSolidPlaces {
 public:
  IgesSolidPlaces(const CleanIges& iges, const std::string& file);

  /// Moves a face made of entity `index`, a face of a solid or not, by what has been left out. Throws ToolError where
  /// two solids put one face in two places, or its surface has a matrix of its own.
  void place(std::size_t index, CadFace& face) const;

 private:
  void note_parents(std::size_t parent, const std::vector<std::size_t>& places);
  [[nodiscard]] std::optional<Eigen::Affine3d> place_of(std::size_t index) const;
  [[nodiscard]] Eigen::Affine3d matrix_of(std::size_t index) const;
  [[noreturn]] void refuse(std::size_t index, const std::string& what) const;

  const CleanIges& iges_;
  std::string file_;
  std::vector<std::vector<std::size_t>> parents_;  ///< of each entity: the shells of a face, the solids of a shell
};

}  // namespace bladefit
