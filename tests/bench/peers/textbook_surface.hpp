#pragma once
#include <Eigen/Core>
#include <Eigen/StdVector>
#include <vector>

#include "tests/bench/peers/peer.hpp"

namespace bladefit::bench {

/// Position [mm] and derivatives with respect to the parameters.
struct TextbookPoint {
  Eigen::Vector3d s, s_u, s_v, s_uu, s_uv, s_vv;
};

/// A NURBS surface as the textbook has it (Piegl and Tiller, The NURBS Book, 2nd ed.): homogeneous control points,
/// basis functions by the recurrence of Cox and de Boor, Newton's method for the foot (6.1). Shares no code with the
/// core.
class TextbookSurface {
 public:
  explicit TextbookSurface(const UnitSurface& surface);

  [[nodiscard]] TextbookPoint evaluate(const Parameters& at) const;

  /// The foot of `r` next to `guess`, clamped to the surface. Ends after a step below `last_step` [mm]: the next one
  /// would be its square.
  [[nodiscard]] Parameters foot(const Eigen::Vector3d& r, const Parameters& guess, double last_step = 1e-7) const;

 private:
  SurfaceDirection u_, v_;
  std::vector<Eigen::Vector4d, Eigen::aligned_allocator<Eigen::Vector4d>> net_;  ///< (w x, w y, w z, w), v fastest
};

}  // namespace bladefit::bench
