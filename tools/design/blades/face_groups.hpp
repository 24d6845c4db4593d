#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/inspection/shaft_axis.hpp"
#include "tools/design/blades/face_samples.hpp"
#include "tools/design/nurbs/neighbours.hpp"

namespace bladefit {

/// Faces that hang together, as they lie about an axis.
struct FaceGroup {
  std::vector<std::size_t> faces;
  double area = 0;          ///< [mm^2]
  double angle = 0;         ///< of the centre about the axis, from `across` towards direction x across [rad]
  double radius = 0;        ///< of the centre [mm]
  double height = 0;        ///< of the centre along the axis [mm]
  double least_radius = 0;  ///< of its places [mm]
  Eigen::Matrix3d spread;   ///< second moments about the centre [mm^2], turned back by `angle`
};

struct FaceGroups {
  std::vector<std::size_t> hub;   ///< surfaces of revolution about the axis, but for those at the end of one group
  std::vector<FaceGroup> groups;  ///< of all other faces
  double hub_area = 0;            ///< [mm^2]
};

/// The direction from which angles about an axis count: +y, made square to the axis; +z where the axis is along y.
[[nodiscard]] Eigen::Vector3d across(const ShaftAxis& axis);

/// The faces apart from those of the hub, in groups whose edges run side by side. A face of revolution that lies beside
/// one group alone and farther out is no hub but the tip of that group.
[[nodiscard]] FaceGroups group_faces(const std::vector<std::vector<FaceSample>>& samples,
                                     const std::vector<Neighbours>& neighbours, const ShaftAxis& axis);

}  // namespace bladefit
