#pragma once
#include <array>
#include <memory>
#include <vector>

#include "core/geometry/surface/surface.hpp"
#include "tools/design/image/framed_piece.hpp"

namespace bladefit {

/// The net of a span.
[[nodiscard]] BezierNet bezier_net_of(const Surface& surface, std::uint32_t span);

/// A rectangle of a patch, in its parameters, and the spans that it lies in.
struct PatchRect {
  std::uint32_t patch, iu_low, iu_high, iv_low, iv_high;
  SpanDomain limits;

  [[nodiscard]] bool holds(const PatchRect& other) const;
};

/// The least that holds both, which lie in one patch.
[[nodiscard]] PatchRect hull_of(const PatchRect& a, const PatchRect& b);

/// Of a part: where its points are, and where its normals look, seen from its middle.
struct PartView {
  PieceFrame frame;      ///< the normal Su x Sv in the middle, the direction of Su, and the third
  IntervalVector place;  ///< of its points, about the middle, in these axes [mm]
  Interval slope[2];     ///< every Su x Sv is a positive multiple of (1, slope[0], slope[1]) in these axes
  double stretch[3];     ///< Sa = stretch[0] Su and Sb = stretch[1] Sv + stretch[2] Su are orthonormal in the middle
  double curvature[2];   ///< in the middle, the largest normal curvature towards Su x Sv and away from it [1/mm]
  bool regular = false;  ///< false: the parametrisation is degenerate, or its normals turn by 90 degrees or more
};

/// A rectangle of a span with its control points, cut in halves when that is asked for.
class SurfacePart {
 public:
  SurfacePart(const Surface& surface, std::uint32_t span, const LocalRect& rect, int cuts);

  [[nodiscard]] const PatchRect& rect() const { return patch_rect_; }
  [[nodiscard]] int cuts() const { return cuts_; }
  /// The longest way across it, nearly [mm].
  [[nodiscard]] double size() const { return size_; }
  /// Of its control points, in a frame.
  [[nodiscard]] IntervalVector box_in(const PieceFrame& frame) const;
  /// Cost: some microseconds, once.
  [[nodiscard]] const PartView& view();
  /// Across its longer side. Cost: two restricted nets, once.
  [[nodiscard]] std::array<SurfacePart*, 2> halves();

 private:
  void make_view();

  const Surface& surface_;
  std::uint32_t span_;
  LocalRect rect_;
  PatchRect patch_rect_;
  int cuts_;
  bool longer_along_s_ = true;
  double size_ = 0;
  std::vector<Vec3> points_;
  std::unique_ptr<PartView> view_;
  std::array<std::unique_ptr<SurfacePart>, 2> halves_;
};

}  // namespace bladefit
