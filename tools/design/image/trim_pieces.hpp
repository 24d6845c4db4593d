#pragma once
#include <vector>

#include "core/geometry/surface/bezier.hpp"
#include "core/geometry/surface/design_image.hpp"
#include "tools/design/image/tree_builder.hpp"
#include "tools/design/nurbs/bezier_extraction.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// The loops cut where they cross from span to span, and so finely that each piece is nearly straight in space.
[[nodiscard]] std::vector<TrimLoop> pieces_of(const std::vector<TrimLoop>& loops, const BezierPatch& patch);

/// What an image holds of the trim loops of all patches.
struct TrimParts {
  std::vector<ImageTrim> pieces;
  std::vector<ImageTrimRun> runs;
  std::vector<ImageSlab> slabs;
  std::vector<std::uint32_t> slab_trims;
  std::vector<Box> boxes;  ///< one a run
};

/// Appends the loops of a patch, as pieces_of() has cut them, with bounds of their derivatives that hold for sure but
/// for rounding, which they allow for. `first_span`: the number of the first span of the patch.
void append_trims(const std::vector<TrimLoop>& loops, const BezierPatch& patch, std::uint32_t first_span,
                  TrimParts& parts);

/// One span of a patch with its loops, as pieces_of() has cut them.
class TrimmedSpan {
 public:
  TrimmedSpan(const std::vector<TrimLoop>& loops, const BezierPatch& patch, std::size_t iu, std::size_t iv);

  /// Some of the face is in the rectangle, or it touches the face. Cost: linear in the number of pieces.
  [[nodiscard]] bool reaches(const LocalRect& rect) const;

 private:
  const std::vector<TrimLoop>& loops_;
  double u_min_, u_max_, v_min_, v_max_;
};

}  // namespace bladefit
