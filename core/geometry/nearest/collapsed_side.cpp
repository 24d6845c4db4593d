#include "core/geometry/nearest/collapsed_side.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

/// Second derivatives of half the squared distance below this share of the first fundamental form are negative.
constexpr double kBendRounding = 1e-9;

/// Control points of a span along one of its sides: those `away` rows from it.
class SideRow {
 public:
  SideRow(const Surface& surface, std::uint32_t span, std::size_t side, std::uint32_t away) {
    const ImagePatch& p = surface.patch_of(span);
    const SpanSource source = source_of(surface.image(), surface.span(span));
    const std::uint32_t degree = is_along_v(side) ? p.degree_u : p.degree_v;
    const std::uint32_t number = is_high(side) ? degree - away : away;
    degree_along_ = is_along_v(side) ? p.degree_v : p.degree_u;
    (is_along_v(side) ? bezier_row : bezier_column)(source, number, points_);
  }

  [[nodiscard]] std::uint32_t degree_along() const { return degree_along_; }
  [[nodiscard]] const Homogeneous& at(std::uint32_t along) const { return points_[along]; }

 private:
  std::uint32_t degree_along_;
  BezierRow points_;
};

bool is_point(const Surface& surface, std::uint32_t span, std::size_t side, double size) {
  const SideRow row(surface, span, side, 0);
  const auto place = [&](std::uint32_t k) {
    const Homogeneous& h = row.at(k);
    return Vec3(h.head<3>() / h[3]);
  };
  const Vec3 first = place(0);
  for (std::uint32_t k = 1; k <= row.degree_along(); ++k) {
    if (!((place(k) - first).squaredNorm() <= size * size)) return false;
  }
  return true;
}

/// The derivative into the surface at the pole is, times a weight, a curve whose control points are those next to the
/// side, seen from the pole: the distance falls nowhere where it falls towards none of them.
bool may_fall(const Surface& surface, std::uint32_t span, std::size_t side, const Vec3& offset, double level) {
  const SideRow on(surface, span, side, 0), inside(surface, span, side, 1);
  for (std::uint32_t k = 0; k <= on.degree_along(); ++k) {
    const Homogeneous &pole = on.at(k), &next = inside.at(k);
    const Vec3 way = next.head<3>() - next[3] / pole[3] * pole.head<3>();
    if (offset.dot(way) > -level * way.norm()) return true;
  }
  return false;
}

class PoleSearch {
 public:
  PoleSearch(const Surface& surface, std::size_t side, const Vec3& offset, double level)
      : surface_(surface), side_(side), offset_(offset), level_(level) {}

  void look_at(const SurfacePlace& place) {
    const SurfacePoint at = surface_.evaluate(place);
    const bool along_v = is_along_v(side_);
    const double sign = is_high(side_) ? -1.0 : 1.0;
    const Vec3& way = along_v ? at.s_u : at.s_v;
    const double length = way.norm();
    if (!(length > 0.0)) return;
    const double slope = -sign * offset_.dot(way) / length;
    const double bend = length * length - offset_.dot(along_v ? at.s_uu : at.s_vv);
    const bool falls = slope < -level_ || (slope <= level_ && bend < -kBendRounding * length * length);
    if (seen_ && (best_.falls && !falls)) return;
    if (seen_ && best_.falls == falls && slope >= best_.slope) return;
    best_ = {place, slope, falls};
    seen_ = true;
  }

  [[nodiscard]] const PoleWay& best() const { return best_; }

 private:
  const Surface& surface_;
  std::size_t side_;
  const Vec3& offset_;
  double level_;
  bool seen_ = false;
  PoleWay best_;
};

}  // namespace

std::size_t pole_side(const Surface& surface, const SurfacePlace& place, const SurfacePoint& at, double size) {
  const auto is_pole = [&](bool there, std::size_t side, const Vec3& along) {
    return there && along.squaredNorm() <= size * size && is_point(surface, place.span, side, size);
  };
  if (is_pole(place.u <= 0.0, kLowU, at.s_v)) return kLowU;
  if (is_pole(place.u >= 1.0, kHighU, at.s_v)) return kHighU;
  if (is_pole(place.v <= 0.0, kLowV, at.s_u)) return kLowV;
  if (is_pole(place.v >= 1.0, kHighV, at.s_u)) return kHighV;
  return kNoSide;
}

SpanPoles poles_of(const Surface& surface, std::uint32_t span, double size) {
  const ImageSpan& s = surface.span(span);
  const ImagePatch& p = surface.patch_of(span);
  SpanPoles poles;
  if (s.iu == 0 && is_point(surface, span, kLowU, size)) {
    poles.u = PoleEnd::low;
  } else if (s.iu + 1 == p.spans_u && is_point(surface, span, kHighU, size)) {
    poles.u = PoleEnd::high;
  }
  if (s.iv == 0 && is_point(surface, span, kLowV, size)) {
    poles.v = PoleEnd::low;
  } else if (s.iv + 1 == p.spans_v && is_point(surface, span, kHighV, size)) {
    poles.v = PoleEnd::high;
  }
  return poles;
}

double pole_cut(double low, double high, double share) {
  constexpr double kSameScale = 4.0;
  const double middle = 0.5 * (low + high);
  if (low <= 0.0) return std::min(middle, share * high);
  return high > kSameScale * low ? std::sqrt(low * high) : middle;
}

double extent_of(const BezierNet& net) {
  const auto place = [&net](std::uint32_t k) { return Vec3(net.points[k].head<3>() / net.points[k][3]); };
  const Vec3 first = place(0);
  double square = 0.0;
  for (std::uint32_t k = 1; k < (net.degree_u + 1) * (net.degree_v + 1); ++k)
    square = std::max(square, (place(k) - first).squaredNorm());
  return 2.0 * std::sqrt(square);
}

PoleWay steepest_from_pole(const Surface& surface, const SurfacePlace& pole, std::size_t side, const Vec3& offset,
                           const ParameterLimits& limits, double level) {
  PoleSearch search(surface, side, offset, level);
  search.look_at(pole);
  const ImageSpan& s = surface.span(pole.span);
  const ImagePatch& p = surface.patch_of(pole.span);
  const bool along_v = is_along_v(side);
  const std::uint32_t count = along_v ? p.spans_v : p.spans_u, step = along_v ? 1 : p.spans_v;
  const std::uint32_t first = pole.span - (along_v ? s.iv : s.iu) * step;
  const double low = along_v ? limits.v_min : limits.u_min, high = along_v ? limits.v_max : limits.u_max;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t span = first + k * step;
    const SpanDomain d = surface.domain(span);
    const double from = std::max(low, along_v ? d.v_min : d.u_min), to = std::min(high, along_v ? d.v_max : d.u_max);
    if (from > to || !may_fall(surface, span, side, offset, level)) continue;
    const std::uint32_t ways = 2 * (along_v ? p.degree_v : p.degree_u);
    for (std::uint32_t way = 0; way <= ways; ++way) {
      const double t = way == ways ? to : from + (to - from) * way / ways;
      search.look_at(along_v ? SurfacePlace{span, pole.u, t} : SurfacePlace{span, t, pole.v});
    }
  }
  return search.best();
}

}  // namespace bladefit
