#include "tests/bench/peers/textbook_surface.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace bladefit::bench {
namespace {

constexpr int kMaxDegree = 9;
constexpr int kMaxNewtonSteps = 50;
using Values = std::array<double, kMaxDegree + 1>;

/// The degree + 1 basis functions that are not zero at a parameter, with two derivatives.
struct Basis {
  int first;  ///< control point of the first of them
  Values value, slope, curvature;
};

/// The span [knots[k], knots[k + 1]) that holds t (A2.1).
int span_of(const SurfaceDirection& d, double t) {
  const auto begin = d.knots.begin() + d.degree, end = d.knots.begin() + d.control_points;
  return static_cast<int>(std::upper_bound(begin + 1, end, t) - d.knots.begin()) - 1;
}

/// From the values of degree p - 1 to those of degree p (2.5).
void raise(const double* knots, int p, double t, Values& n) {
  double saved = 0;
  for (int j = 0; j < p; ++j) {
    const double right = knots[j + 1] - t, left = t - knots[j + 1 - p];
    const double share = n[static_cast<std::size_t>(j)] / (right + left);
    n[static_cast<std::size_t>(j)] = saved + right * share;
    saved = left * share;
  }
  n[static_cast<std::size_t>(p)] = saved;
}

/// From functions of degree p - 1 to the derivatives of those of degree p (2.7).
Values differentiated(const double* knots, int p, const Values& lower) {
  Values slope;
  double before = 0;
  for (int j = 0; j <= p; ++j) {
    const double after = j < p ? p * lower[static_cast<std::size_t>(j)] / (knots[j + 1] - knots[j + 1 - p]) : 0.0;
    slope[static_cast<std::size_t>(j)] = before - after;
    before = after;
  }
  return slope;
}

Basis basis_at(const SurfaceDirection& d, double t) {
  const int span = span_of(d, t);
  const double* knots = d.knots.data() + span;
  Basis b;
  b.first = span - d.degree;
  b.curvature.fill(0.0);
  b.value[0] = 1.0;
  for (int p = 1; p <= d.degree; ++p) {
    if (p == d.degree - 1) b.curvature = differentiated(knots, p, b.value);
    if (p == d.degree) {
      b.slope = differentiated(knots, p, b.value);
      if (p > 1) b.curvature = differentiated(knots, p, b.curvature);
    }
    raise(knots, p, t, b.value);
  }
  return b;
}

/// Newton's step of half the squared distance; Gauss-Newton's where the Hessian is not positive definite.
Eigen::Vector2d step_at(const TextbookPoint& p, const Eigen::Vector3d& offset) {
  const Eigen::Vector2d gradient(-offset.dot(p.s_u), -offset.dot(p.s_v));
  Eigen::Matrix2d first, hessian;
  first << p.s_u.squaredNorm(), p.s_u.dot(p.s_v), p.s_u.dot(p.s_v), p.s_v.squaredNorm();
  hessian << first(0, 0) - offset.dot(p.s_uu), first(0, 1) - offset.dot(p.s_uv), first(0, 1) - offset.dot(p.s_uv),
      first(1, 1) - offset.dot(p.s_vv);
  const bool convex = hessian(0, 0) > 0.0 && hessian.determinant() > 1e-9 * first.determinant();
  return -(convex ? hessian : first).inverse() * gradient;
}

Parameters clamped(const Parameters& at, const Eigen::Vector2d& step) {
  return {std::clamp(at.u + step.x(), 0.0, 1.0), std::clamp(at.v + step.y(), 0.0, 1.0)};
}

}  // namespace

TextbookSurface::TextbookSurface(const UnitSurface& surface) : u_(surface.u), v_(surface.v) {
  for (std::size_t k = 0; k < surface.control_points.size(); ++k) {
    const double w = surface.weights[k];
    net_.emplace_back((Eigen::Vector4d() << w * surface.control_points[k], w).finished());
  }
}

TextbookPoint TextbookSurface::evaluate(const Parameters& at) const {
  const Basis bu = basis_at(u_, at.u), bv = basis_at(v_, at.v);
  Eigen::Vector4d h = Eigen::Vector4d::Zero(), h_u = h, h_v = h, h_uu = h, h_uv = h, h_vv = h;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(u_.degree); ++i) {
    const Eigen::Vector4d* row =
        &net_[static_cast<std::size_t>((bu.first + static_cast<int>(i)) * v_.control_points + bv.first)];
    Eigen::Vector4d c = bv.value[0] * row[0], c_v = bv.slope[0] * row[0], c_vv = bv.curvature[0] * row[0];
    for (std::size_t j = 1; j <= static_cast<std::size_t>(v_.degree); ++j) {
      c += bv.value[j] * row[j];
      c_v += bv.slope[j] * row[j];
      c_vv += bv.curvature[j] * row[j];
    }
    h += bu.value[i] * c;
    h_u += bu.slope[i] * c;
    h_uu += bu.curvature[i] * c;
    h_v += bu.value[i] * c_v;
    h_uv += bu.slope[i] * c_v;
    h_vv += bu.value[i] * c_vv;
  }
  const double w = 1.0 / h.w();  // quotient rule (4.20)
  TextbookPoint p;
  p.s = w * h.head<3>();
  p.s_u = w * (h_u.head<3>() - h_u.w() * p.s);
  p.s_v = w * (h_v.head<3>() - h_v.w() * p.s);
  p.s_uu = w * (h_uu.head<3>() - 2.0 * h_u.w() * p.s_u - h_uu.w() * p.s);
  p.s_uv = w * (h_uv.head<3>() - h_u.w() * p.s_v - h_v.w() * p.s_u - h_uv.w() * p.s);
  p.s_vv = w * (h_vv.head<3>() - 2.0 * h_v.w() * p.s_v - h_vv.w() * p.s);
  return p;
}

Parameters TextbookSurface::foot(const Eigen::Vector3d& r, const Parameters& guess, double last_step) const {
  Parameters at = guess;
  TextbookPoint p = evaluate(at);
  for (int k = 0; k < kMaxNewtonSteps; ++k) {
    const Eigen::Vector3d offset = r - p.s;
    Eigen::Vector2d step = step_at(p, offset);
    // A border holds its parameter: the other is then found alone.
    if ((at.u <= 0.0 && step.x() < 0.0) || (at.u >= 1.0 && step.x() > 0.0)) {
      const double slope = p.s_v.squaredNorm() - offset.dot(p.s_vv);
      step = {0.0, offset.dot(p.s_v) / (slope > 0.0 ? slope : p.s_v.squaredNorm())};
    } else if ((at.v <= 0.0 && step.y() < 0.0) || (at.v >= 1.0 && step.y() > 0.0)) {
      const double slope = p.s_u.squaredNorm() - offset.dot(p.s_uu);
      step = {offset.dot(p.s_u) / (slope > 0.0 ? slope : p.s_u.squaredNorm()), 0.0};
    }
    const double length = (p.s_u * step.x() + p.s_v * step.y()).norm();
    if (length <= last_step) return clamped(at, step);
    Parameters next = clamped(at, step);
    TextbookPoint there = evaluate(next);
    for (int h = 0; h < 20 && (r - there.s).squaredNorm() > offset.squaredNorm() * (1.0 + 1e-12); ++h) {
      step *= 0.5;
      next = clamped(at, step);
      there = evaluate(next);
    }
    at = next;
    p = there;
  }
  return at;
}

}  // namespace bladefit::bench
