#pragma once
#include <Eigen/Core>
#include <span>

namespace bladefit {

/// Bounds directions: each is within acos(cosine) of the unit vector `axis`. Cosine -1: no bound is known.
struct NormalCone {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double cosine = -1;
};

/// The cone of Su x Sv over one Bezier span, times `outward` (+1 or -1). `coefficients` are the span's, as in
/// BezierPatch. Never too narrow: the direction of Su x Sv is written as a Bezier net of its own, whose control vectors
/// span a convex cone around every normal. Where the span is degenerate no bound is returned.
NormalCone normal_cone(std::span<const double> coefficients, int degree_u, int degree_v, int outward);

}  // namespace bladefit
