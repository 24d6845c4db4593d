#pragma once
#include <vector>

#include "core/geometry/surface/design_image.hpp"
#include "tools/design/image/image_size.hpp"
#include "tools/design/image/leaf_subdivision.hpp"
#include "tools/design/image/normal_cone.hpp"
#include "tools/design/nurbs/bezier_extraction.hpp"

namespace bladefit {

/// What bounds one span.
struct SpanBounding {
  NormalCone cone;
  LeafTree leaves;
};

/// The bounds of every span of a patch. `outward` and `near` as of normal_cone() and cut_into_leaves(),
/// which cuts the spans unless `size` is compact.
/// Works on all cores: this is most of the time of compiling a design, a tenth of a millisecond a span and core. The
/// outcome does not depend on their number.
std::vector<SpanBounding> bound_spans(const BezierPatch& bezier, int outward, double near, ImageSize size);

}  // namespace bladefit
