#pragma once

namespace bladefit {

/// The Hessian counts as positive definite where its determinant is above this share of the product of the squared
/// tangents.
inline constexpr double kConvexDeterminant = 1e-9;

/// Gradient and Hessian of half the squared distance from a point to the surface, in two parameters of the surface.
struct DistanceQuadratic {
  double g_u, g_v, h_uu, h_uv, h_vv;
  double m_uu, m_uv, m_vv;  ///< first fundamental form

  /// Newton's step. False, and nothing written, where the squared distance is not convex.
  [[gnu::always_inline]] inline bool newton_step(double& du, double& dv) const {
    const double det = h_uu * h_vv - h_uv * h_uv;
    if (!(h_uu > 0.0 && det > kConvexDeterminant * m_uu * m_vv)) return false;
    const double inverse = 1.0 / det;
    du = -(h_vv * g_u - h_uv * g_v) * inverse;
    dv = -(h_uu * g_v - h_uv * g_u) * inverse;
    return true;
  }
};

/// Of the tangents and second derivatives of the surface and the offset r - S; `dot` is the scalar product of two.
template <class Vector, class Dot>
[[gnu::always_inline]] inline DistanceQuadratic quadratic_at(const Vector& s_u, const Vector& s_v, const Vector& s_uu,
                                                             const Vector& s_uv, const Vector& s_vv,
                                                             const Vector& offset, Dot dot) {
  const double m_uu = dot(s_u, s_u), m_uv = dot(s_u, s_v), m_vv = dot(s_v, s_v);
  return {-dot(offset, s_u),
          -dot(offset, s_v),
          m_uu - dot(offset, s_uu),
          m_uv - dot(offset, s_uv),
          m_vv - dot(offset, s_vv),
          m_uu,
          m_uv,
          m_vv};
}

}  // namespace bladefit
