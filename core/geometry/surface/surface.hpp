#pragma once
#include <cstdint>

#include "core/geometry/surface/design_image.hpp"
#include "core/geometry/surface/foot.hpp"
#include "core/geometry/surface/span_net.hpp"
#include "core/geometry/surface/taylor.hpp"

namespace bladefit {

/// The middle of the box that the header names: what single-precision boxes are about, and the pivot of motions [mm].
[[nodiscard]] Vec3 middle_of(const ImageHeader& header);

/// A place on the design: a span and normalised patch parameters inside it.
struct SurfacePlace {
  std::uint32_t span = 0;
  double u = 0, v = 0;
};

/// Room for a Taylor form of any degrees.
using TaylorRoom = std::array<double, 4 * kMaxOrder * kMaxOrder>;

/// Position [mm] and derivatives with respect to the normalised patch parameters.
struct SurfacePoint {
  Vec3 s, s_u, s_v, s_uu, s_uv, s_vv;
};

/// A / w and its derivatives by the quotient rule, in the parameters of `h`.
[[nodiscard]] SurfacePoint projected(const HomogeneousDerivatives& h);

/// The same in parameters that run `per_u` and `per_v` times slower: derivatives are scaled.
[[nodiscard]] inline SurfacePoint scaled(const SurfacePoint& point, double per_u, double per_v) {
  return {point.s,
          per_u * point.s_u,
          per_v * point.s_v,
          per_u * per_u * point.s_uu,
          per_u * per_v * point.s_uv,
          per_v * per_v * point.s_vv};
}

/// Rectangle of one span in the normalised parameters of its patch.
struct SpanDomain {
  double u_min, u_max, v_min, v_max;
};

/// The design surface of a validated image. A view: the image's memory must outlive it.
class Surface {
 public:
  explicit Surface(const DesignImage& image);

  [[nodiscard]] const DesignImage& image() const { return image_; }
  [[nodiscard]] const ImageSpan& span(std::uint32_t index) const { return image_.spans()[index]; }
  [[nodiscard]] const ImagePatch& patch_of(std::uint32_t span_index) const {
    return image_.patches()[span(span_index).patch];
  }
  /// The control points of a span's Bezier form. Cost: that of bezier_points().
  void net(std::uint32_t span_index, BezierNet& out) const;
  /// The image holds the Taylor forms of its spans.
  [[nodiscard]] bool holds_taylor() const { return !image_.taylor().empty(); }
  /// A span's Taylor form: the image's, or worked out into `room`, which then has to live as long. Cost: nothing, or
  /// that of bezier_points() and to_taylor_form().
  [[nodiscard]] const double* taylor(std::uint32_t span_index, double* room) const {
    if (holds_taylor()) return image_.taylor().data() + 4U * static_cast<std::size_t>(span(span_index).first_taylor);
    work_out_taylor(span_index, room);
    return room;
  }
  [[nodiscard]] SpanDomain domain(std::uint32_t span_index) const {
    const ImageSpan& s = span(span_index);
    const ImagePatch& p = image_.patches()[s.patch];
    const double* bu = image_.breaks().data() + p.first_break_u + s.iu;
    const double* bv = image_.breaks().data() + p.first_break_v + s.iv;
    return {bu[0], bu[1], bv[0], bv[1]};
  }

  /// Evaluates at `place`, which must lie inside its span. Cost: one Taylor form (thesis 3-4).
  [[nodiscard]] SurfacePoint evaluate(const SurfacePlace& place) const;

  /// Sets place.span to the span of the same patch that holds (u, v), walking from the present one.
  /// Cost: one step a span crossed, at most spans_u + spans_v.
  void settle(SurfacePlace& place) const;

  /// The place at (u, v) of a patch. Cost: linear in the number of spans of a row and a column.
  [[nodiscard]] SurfacePlace place_at(std::uint32_t patch, double u, double v) const;

  /// Some patch has trim loops.
  [[nodiscard]] bool has_trims() const { return !image_.trims().empty(); }

  /// The outward side of a span's patch: +1 that of Su x Sv, -1 the other one.
  [[nodiscard]] double side_of(std::uint32_t span_index) const {
    const auto side = static_cast<double>(image_.header().outward);
    return patch_of(span_index).reversed != 0 ? -side : side;
  }

  /// A vector along the outward normal, of no particular length: cheaper.
  [[nodiscard]] Vec3 outward(const SurfacePlace& place, const SurfacePoint& point) const;

  /// Outward unit normal; where the parametrisation is degenerate (Su x Sv = 0), that of a place a little further
  /// inside.
  [[nodiscard]] Vec3 normal(const SurfacePlace& place, const SurfacePoint& point) const;

  /// Half the diagonal of the box of the control points [mm]: the scale of all tolerances.
  [[nodiscard]] double half_diagonal() const { return half_diagonal_; }
  /// The middle of that box [mm].
  [[nodiscard]] const Vec3& middle() const { return middle_; }

 private:
  void work_out_taylor(std::uint32_t span_index, double* room) const;
  [[nodiscard]] SurfacePoint evaluate_form(const SurfacePlace& place, const double* taylor) const;
  [[nodiscard]] SurfacePoint evaluate_worked_out(const SurfacePlace& place) const;

  DesignImage image_;
  double half_diagonal_;
  Vec3 middle_;
};

}  // namespace bladefit
