#include "core/geometry/surface/surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bladefit {

Vec3 middle_of(const ImageHeader& header) { return 0.5 * (Vec3(header.box_min) + Vec3(header.box_max)); }

Surface::Surface(const DesignImage& image) : image_(image), middle_(middle_of(image.header())) {
  const ImageHeader& h = image.header();
  half_diagonal_ = 0.5 * (Vec3(h.box_max) - Vec3(h.box_min)).norm();
}

SurfacePoint projected(const HomogeneousDerivatives& h) {
  HomogeneousDerivatives p = h;
  project(p);
  return {p.a.head<3>(), p.a_u.head<3>(), p.a_v.head<3>(), p.a_uu.head<3>(), p.a_uv.head<3>(), p.a_vv.head<3>()};
}

void Surface::net(std::uint32_t span_index, BezierNet& out) const { bezier_net(image_, span(span_index), out); }

void Surface::work_out_taylor(std::uint32_t span_index, double* room) const {
  const SpanSource source = source_of(image_, span(span_index));
  bezier_points(source, room);
  to_taylor_form(source.degree_u, source.degree_v, room);
}

SurfacePoint Surface::evaluate(const SurfacePlace& place) const {
  return holds_taylor() ? evaluate_form(place, taylor(place.span, nullptr)) : evaluate_worked_out(place);
}

// Apart, so that the room is taken from the stack where it is needed only.
[[gnu::noinline]] SurfacePoint Surface::evaluate_worked_out(const SurfacePlace& place) const {
  TaylorRoom room;
  return evaluate_form(place, taylor(place.span, room.data()));
}

SurfacePoint Surface::evaluate_form(const SurfacePlace& place, const double* taylor) const {
  const ImagePatch& p = patch_of(place.span);
  const SpanDomain d = domain(place.span);
  const double scale_u = 1.0 / (d.u_max - d.u_min), scale_v = 1.0 / (d.v_max - d.v_min);
  HomogeneousDerivatives h;
  evaluate_taylor(taylor, p.degree_u, p.degree_v, (place.u - d.u_min) * scale_u - 0.5,
                  (place.v - d.v_min) * scale_v - 0.5, h);
  return scaled(projected(h), scale_u, scale_v);
}

void Surface::settle(SurfacePlace& place) const {
  const ImageSpan& s = span(place.span);
  const ImagePatch& p = image_.patches()[s.patch];
  const double* bu = image_.breaks().data() + p.first_break_u;
  const double* bv = image_.breaks().data() + p.first_break_v;
  std::uint32_t iu = s.iu, iv = s.iv;
  while (iu > 0 && place.u < bu[iu]) --iu;
  while (iu + 1 < p.spans_u && place.u > bu[iu + 1]) ++iu;
  while (iv > 0 && place.v < bv[iv]) --iv;
  while (iv + 1 < p.spans_v && place.v > bv[iv + 1]) ++iv;
  place.span = p.first_span + iu * p.spans_v + iv;
}

SurfacePlace Surface::place_at(std::uint32_t patch, double u, double v) const {
  SurfacePlace place{image_.patches()[patch].first_span, u, v};
  settle(place);
  return place;
}

Vec3 Surface::outward(const SurfacePlace& place, const SurfacePoint& point) const {
  const double side = side_of(place.span);
  const Vec3 cross = point.s_u.cross(point.s_v);
  const double sizes = point.s_u.squaredNorm() + point.s_v.squaredNorm();
  if (cross.squaredNorm() > 1e-24 * sizes * sizes) return side * cross;
  SurfacePlace inside{place.span, place.u + 1e-6 * (0.5 - place.u), place.v + 1e-6 * (0.5 - place.v)};
  settle(inside);
  const SurfacePoint moved = evaluate(inside);
  const Vec3 other = moved.s_u.cross(moved.s_v);
  return other.squaredNorm() > 0.0 ? Vec3(side * other) : Vec3(Vec3::UnitZ());
}

Vec3 Surface::normal(const SurfacePlace& place, const SurfacePoint& point) const {
  return outward(place, point).normalized();
}

}  // namespace bladefit
