#include "core/fit/quadratic_model.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/algebra/cross_matrix.hpp"
#include "core/geometry/surface/trim.hpp"

namespace bladefit {
namespace {

/// Directions in space as directions in x: [Jl(w)' (a x direction) / L, direction], Jl the left Jacobian of the
/// rotation, taken to first order.
class Lever {
 public:
  Lever(const Vec3& r, const Vec6& x, const MotionFrame& frame)
      : arm_(r - frame.pivot - x.tail<3>()),
        half_w_(0.5 / frame.length * x.head<3>()),
        inverse_length_(1.0 / frame.length) {}

  [[nodiscard]] Vec6 operator()(const Vec3& direction) const {
    const Vec3 moment = arm_.cross(direction);
    Vec6 out;
    out.head<3>() = inverse_length_ * (moment + moment.cross(half_w_));
    out.tail<3>() = direction;
    return out;
  }
  [[nodiscard]] const Vec3& arm() const { return arm_; }

 private:
  Vec3 arm_, half_w_;
  double inverse_length_;
};

void add_outer(Mat6& m, double factor, const Vec6& a, const Vec6& b) {
  for (int j = 0; j < 6; ++j) {
    const double f = factor * b[j];
    for (int i = 0; i < 6; ++i) m(i, j) += f * a[i];
  }
}

/// dn/dr = -T G^-1 B M^-1 T' on a smooth foot: G, B first and second fundamental form, M = G - phi B, T = [Su Sv].
/// The same in lanes, to the same bits: core/lanes/lane_rows.cpp; and so add_rotation_bend().
void add_surface_bend(const Projection& p, const Vec3& n, const Lever& lever, Mat6& bend) {
  const SurfacePoint& s = p.at;
  const double phi = n.dot(p.offset);
  const double g_uu = s.s_u.squaredNorm(), g_uv = s.s_u.dot(s.s_v), g_vv = s.s_v.squaredNorm();
  const double b_uu = n.dot(s.s_uu), b_uv = n.dot(s.s_uv), b_vv = n.dot(s.s_vv);
  const double m_uu = g_uu - phi * b_uu, m_uv = g_uv - phi * b_uv, m_vv = g_vv - phi * b_vv;
  const double det = (g_uu * g_vv - g_uv * g_uv) * (m_uu * m_vv - m_uv * m_uv);
  if (!(std::abs(det) > 1e-24 * g_uu * g_uu * g_vv * g_vv)) return;
  // K = adj(G) B adj(M), symmetric because B commutes with G^-1 and M^-1 in this product.
  const double x_uu = g_vv * b_uu - g_uv * b_uv, x_uv = g_vv * b_uv - g_uv * b_vv;
  const double x_vu = g_uu * b_uv - g_uv * b_uu, x_vv = g_uu * b_vv - g_uv * b_uv;
  const double k_uu = x_uu * m_vv - x_uv * m_uv, k_uv = x_uv * m_uu - x_uu * m_uv;
  const double k_vv = x_vv * m_uu - x_vu * m_uv;
  const Vec6 l_u = lever(s.s_u), l_v = lever(s.s_v);
  add_outer(bend, -1.0 / det, l_u, k_uu * l_u + k_uv * l_v);
  add_outer(bend, -1.0 / det, l_v, k_uv * l_u + k_vv * l_v);
}

/// A curve that a projection is held at: its first and second derivative.
struct HeldCurve {
  Vec3 tangent, second;
};

/// That of a trim loop is straight in the parameters.
HeldCurve held_curve(const Projection& p) {
  if (p.on_trim()) return {tangent_along(p.at, p.trim.du, p.trim.dv), second_along(p.at, p.trim.du, p.trim.dv)};
  return p.fixed_u ? HeldCurve{p.at.s_v, p.at.s_vv} : HeldCurve{p.at.s_u, p.at.s_uu};
}

/// (I - n n' - t t' / (t.t - e.S_tt)) / |e| on an edge with tangent t; without t at a corner. Where n points against e,
/// the distance is negative, and so is this.
void add_curve_bend(const Projection& p, const Vec3& n, const Lever& lever, Mat6& bend) {
  const double inverse = std::copysign(1.0 / p.offset.norm(), n.dot(p.offset));
  for (int k = 0; k < 3; ++k) {
    const Vec6 l = lever(Vec3::Unit(k));
    add_outer(bend, inverse, l, l);
  }
  const Vec6 l_n = lever(n);
  add_outer(bend, -inverse, l_n, l_n);
  if ((p.fixed_u && p.fixed_v) || p.trim.at_corner) return;
  const HeldCurve curve = held_curve(p);
  const Vec3& t = curve.tangent;
  const double denominator = t.squaredNorm() - p.offset.dot(curve.second);
  if (!(denominator > 1e-9 * t.squaredNorm())) return;
  const Vec6 l_t = lever(t);
  add_outer(bend, -inverse / denominator, l_t, l_t);
}

/// n . d^2 r / dw^2 = 1/2 (n a' + a n') - (n . a) I for r = exp([w]x) a.
void add_rotation_bend(const Vec3& n, const Vec3& arm, double length, Mat6& bend) {
  const double f = 1.0 / (length * length);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) bend(i, j) += 0.5 * f * (n[i] * arm[j] + arm[i] * n[j]);
    bend(i, i) -= f * n.dot(arm);
  }
}

/// dx / dy at y = 0 of the motion x followed by a motion y: exp([y]x) exp([w]x) = exp([w + Jl^-1 y]x), s' = exp([y]x) s
/// + y. The inverse left Jacobian to w^3.
Mat6 change_of_motion(const Vec6& x, double length) {
  const Mat3 turn = cross_matrix(x.head<3>() / length);
  Mat6 change = Mat6::Identity();
  change.topLeftCorner<3, 3>() += -0.5 * turn + turn * turn / 12.0;
  change.bottomLeftCorner<3, 3>() = -cross_matrix(x.tail<3>()) / length;
  return change;
}

Vec6 unscaled(const Vec6& x, double length) {
  Vec6 step = x;
  step.head<3>() /= length;
  return step;
}

}  // namespace

Pose moved(const Pose& pose, const Vec6& x, const MotionFrame& frame) {
  return moved(pose, unscaled(x, frame.length), frame.pivot);
}

Vec6 motion_between(const Pose& from, const Pose& to, const MotionFrame& frame) {
  Vec6 x = step_between(from, to, frame.pivot);
  x.head<3>() *= frame.length;
  return x;
}

DistanceRow distance_row(const Projection& projection, const Foot& foot, const Vec3& r, const Vec6& x,
                         const MotionFrame& frame) {
  const Lever lever(r, x, frame);
  DistanceRow row;
  row.distance = foot.distance;
  Vec3 n = foot.normal;
  const double length = projection.offset.norm();
  const bool of_edge = (projection.fixed_u || projection.fixed_v || projection.on_trim()) && length > 0.0;
  if (of_edge) {
    // The distance is that to the curve, with a sign at a seam or a joint.
    const double side = n.dot(projection.offset) < 0.0 ? -1.0 : 1.0;
    n = projection.offset * (side / length);
    add_curve_bend(projection, n, lever, row.bend);
    row.bend *= side;
  } else {
    add_surface_bend(projection, n, lever, row.bend);
  }
  row.gradient = lever(n);
  add_rotation_bend(n, lever.arm(), frame.length, row.bend);
  row.bend.triangularView<Eigen::StrictlyLower>() = row.bend.transpose();
  return row;
}

void QuadraticModel::add(const DistanceRow& row, const Vec6& x, double w, const LossTerms& terms) {
  const double slope = w * terms.slope, curvature = w * terms.curvature;
  add_outer(gauss, w * terms.weight, row.gradient, row.gradient);
  const Vec6 bend_x = slope * (row.bend * x);
  const double along = row.gradient.dot(x);
  bend += slope * row.bend;
  if (terms.curvature != terms.weight) add_outer(bend, curvature - w * terms.weight, row.gradient, row.gradient);
  gradient += (slope - curvature * along) * row.gradient - bend_x;
  half_square += w * terms.value - slope * along + 0.5 * curvature * along * along + 0.5 * x.dot(bend_x);
  weight += w * terms.weight;
  ++count;
}

double QuadraticModel::value_at(const Vec6& x) const {
  return std::max(0.0, half_square + gradient.dot(x) + 0.5 * x.dot((gauss + bend) * x));
}

QuadraticModel shifted(const QuadraticModel& model, const Pose& reference, const MotionFrame& frame) {
  QuadraticModel out = model;
  const Vec6 x = motion_between(model.reference, reference, frame);
  const Mat6 change = change_of_motion(x, frame.length);
  out.reference = reference;
  out.gradient = change.transpose() * (model.gradient + (model.gauss + model.bend) * x);
  out.gauss = change.transpose() * model.gauss * change;
  out.bend = change.transpose() * model.bend * change;
  out.half_square = model.value_at(x);
  return out;
}

}  // namespace bladefit
