#include "core/geometry/surface/trim_check.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/surface/trim.hpp"

namespace bladefit {
namespace {

/// The start of a piece may be off the surface by this share of the design's size.
constexpr double kStartRounding = 1e-10;

bool lies_in(const SpanDomain& d, const ImageTrim& trim) {
  return trim.u >= d.u_min && trim.u <= d.u_max && trim.v >= d.v_min && trim.v <= d.v_max;
}

bool trim_valid(const Surface& surface, std::uint32_t index) {
  const DesignImage& image = surface.image();
  const ImageTrim& trim = image.trims()[index];
  const std::size_t count = image.trims().size();
  if (trim.span >= image.spans().size() || trim.next >= count || trim.previous >= count) return false;
  if (surface.patch_of(trim.span).slab_count == 0 || trim.corner > 1 || !is_joint(trim.joint)) return false;
  const ImageTrim& next = image.trims()[trim.next];
  if (next.previous != index || next.span >= image.spans().size()) return false;
  const SpanDomain domain = surface.domain(trim.span);
  if (surface.span(next.span).patch != surface.span(trim.span).patch) return false;
  if (!lies_in(domain, trim) || !lies_in(domain, next)) return false;
  for (const double bound : {trim.slope, trim.bend, trim.third}) {
    if (!std::isfinite(bound) || bound < 0.0) return false;
  }
  const Vec3 start(trim.start);
  const double off = (start - surface.evaluate({trim.span, trim.u, trim.v}).s).norm();
  return off <= kStartRounding * (surface.half_diagonal() + surface.middle().norm());
}

bool runs_valid(const DesignImage& image) {
  std::uint64_t next = 0;
  for (const ImageTrimRun& run : image.runs()) {
    if (run.first != next || run.count < 1 || run.count > kMostTrimsInRun || run.spare != 0) return false;
    next += run.count;
    if (next > image.trims().size()) return false;
  }
  return next == image.trims().size();
}

/// The slabs of the patches follow each other, and so do their trims, which are rising.
bool slabs_valid(const DesignImage& image) {
  std::uint64_t next_slab = 0, next_trim = 0;
  for (std::uint32_t patch = 0; patch < image.patches().size(); ++patch) {
    const ImagePatch& p = image.patches()[patch];
    if (p.first_slab != next_slab) return false;
    next_slab += p.slab_count;
    if (next_slab > image.slabs().size()) return false;
    for (const ImageSlab& slab : image.slabs().subspan(p.first_slab, p.slab_count)) {
      if (slab.first != next_trim) return false;
      next_trim += slab.count;
      if (next_trim > image.slab_trims().size()) return false;
      const auto trims = image.slab_trims().subspan(slab.first, slab.count);
      for (std::size_t k = 0; k < trims.size(); ++k) {
        if (trims[k] >= image.trims().size() || (k > 0 && trims[k] <= trims[k - 1])) return false;
        const std::uint32_t span = image.trims()[trims[k]].span;
        if (span >= image.spans().size() || image.spans()[span].patch != patch) return false;
      }
    }
  }
  return next_slab == image.slabs().size() && next_trim == image.slab_trims().size();
}

/// Every slab that the piece reaches into holds it. Together with the number of trims in all slabs this bounds the
/// cost.
bool held_by_slabs(const DesignImage& image, std::uint32_t index) {
  const ImageTrim& trim = image.trims()[index];
  const ImagePatch& patch = image.patches()[image.spans()[trim.span].patch];
  const double end = image.trims()[trim.next].v;
  const std::uint32_t last = slab_of(std::max(trim.v, end), patch.slab_count);
  for (std::uint32_t k = slab_of(std::min(trim.v, end), patch.slab_count); k <= last; ++k) {
    const ImageSlab& slab = image.slabs()[patch.first_slab + k];
    const auto trims = image.slab_trims().subspan(slab.first, slab.count);
    if (!std::binary_search(trims.begin(), trims.end(), index)) return false;
  }
  return true;
}

}  // namespace

bool trims_valid(const DesignImage& image) {
  if (!runs_valid(image) || !slabs_valid(image)) return false;
  const Surface surface(image);
  for (std::uint32_t k = 0; k < image.trims().size(); ++k) {
    if (!trim_valid(surface, k) || !held_by_slabs(image, k)) return false;
  }
  return true;
}

}  // namespace bladefit
