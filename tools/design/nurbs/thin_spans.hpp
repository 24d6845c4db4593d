#pragma once
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// What merging thin spans did to a surface.
struct MergedSpans {
  int spans_u = 0, spans_v = 0;  ///< that are gone
  double moved_mm = 0;           ///< no place that was looked at moved farther, its parameters being the same
  [[nodiscard]] int count() const { return spans_u + spans_v; }
};

/// Makes knots one that are hair-thin spans apart, as lofts have them that merge the knots of several sections: such a
/// span is thousands of times longer than wide, and its derivatives are the rounding of its control points. Where more
/// knots than the degree come together, the control points that they leave without a place of their own go. Spans up
/// to a millionth of the range are merged, or of a smaller part of it, so that no place that is looked at, five in each
/// direction of every span that is left or gone, moves farther than `tolerance_mm`; a surface without such spans stays
/// as it is. `surface` is one that check_surface has accepted. Cost: linear in the number of spans.
MergedSpans merge_thin_spans(NurbsSurface& surface, double tolerance_mm);

}  // namespace bladefit
