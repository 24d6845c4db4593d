#include "core/geometry/surface/tree_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/surface/surface.hpp"

namespace bladefit {
namespace {

/// A node that is still to be visited, with the place in its parent that it stands in.
struct Visit {
  std::uint32_t node = 0, parent = 0, place = 0, depth = 0;
};

class TreeCheck {
 public:
  explicit TreeCheck(const DesignImage& image) : image_(image), middle_(middle_of(image.header())) {}

  bool run() {
    pending_[0] = {};
    size_ = 1;
    for (std::uint32_t k = 0; k < image_.nodes().size(); ++k) {
      if (size_ == 0) return false;
      const Visit visit = pending_[--size_];
      if (visit.node != k || visit.depth >= kMaxTreeDepth) return false;
      if (!children_valid(visit)) return false;
    }
    return size_ == 0 && leaves_ == image_.leaves().size() && runs_ == image_.runs().size();
  }

 private:
  bool children_valid(const Visit& visit) {
    const ImageNode& node = image_.nodes()[visit.node];
    if (node.child[0] == kNoChild) return false;
    // The first child comes next, so it is put on top.
    for (std::uint32_t place = 4; place-- > 0;) {
      const std::uint32_t child = node.child[place];
      if (!box_valid(node, place) || (visit.node > 0 && !nested(visit, place))) return false;
      if (child == kNoChild) continue;
      if (std::count(node.child, node.child + 4, child) > 1) return false;
      if ((child & kLeafChild) != 0) {
        const bool leaf = (child & ~kLeafChild) < image_.leaves().size();
        if (leaf ? !leaf_valid(visit.node, place) : !run_valid(visit.node, place)) return false;
        ++(leaf ? leaves_ : runs_);
      } else {
        pending_[size_++] = {child, visit.node, place, visit.depth + 1};
      }
    }
    return true;
  }

  /// Finite where there is a child; where there is none, farther than everything.
  static bool box_valid(const ImageNode& node, std::uint32_t place) {
    for (int axis = 0; axis < 3; ++axis) {
      const float low = node.low[axis][place], high = node.high[axis][place];
      const bool empty = std::isinf(low) && low > 0.0F && std::isinf(high) && high < 0.0F;
      const bool finite = std::isfinite(low) && std::isfinite(high) && low <= high;
      if (node.child[place] == kNoChild ? !empty : !finite) return false;
    }
    return true;
  }

  [[nodiscard]] bool nested(const Visit& visit, std::uint32_t place) const {
    const ImageNode& inner = image_.nodes()[visit.node];
    const ImageNode& outer = image_.nodes()[visit.parent];
    for (int axis = 0; axis < 3; ++axis) {
      if (!(inner.low[axis][place] >= outer.low[axis][visit.place]) ||
          !(inner.high[axis][place] <= outer.high[axis][visit.place]))
        return false;
    }
    return true;
  }

  /// The control points of the leaf's rectangle are inside its box, which the search relies on.
  [[nodiscard]] bool leaf_valid(std::uint32_t index, std::uint32_t place) const {
    const ImageNode& node = image_.nodes()[index];
    const ImageLeaf& leaf = image_.leaves()[node.child[place] & ~kLeafChild];
    const ImageSpan& s = image_.spans()[leaf.span];
    const ImagePatch& p = image_.patches()[s.patch];
    BezierNet net;
    bezier_net(image_, s, net);
    restrict_net(rect_of(leaf), net);
    for (std::uint32_t n = 0; n < (p.degree_u + 1) * (p.degree_v + 1); ++n) {
      const Homogeneous& c = net.points[n];
      for (int axis = 0; axis < 3; ++axis) {
        const double x = c[axis] / c[3] - middle_[axis];
        if (!(x >= static_cast<double>(node.low[axis][place]) && x <= static_cast<double>(node.high[axis][place])))
          return false;
      }
    }
    return leaf.node == index;
  }

  /// The ends of its pieces are inside its box. That what lies between them is too is the compiler's promise.
  [[nodiscard]] bool run_valid(std::uint32_t index, std::uint32_t place) const {
    const ImageNode& node = image_.nodes()[index];
    const std::size_t number = (node.child[place] & ~kLeafChild) - image_.leaves().size();
    if (number >= image_.runs().size()) return false;
    const ImageTrimRun& run = image_.runs()[number];
    for (std::uint32_t k = run.first; k < run.first + run.count; ++k) {
      const ImageTrim& trim = image_.trims()[k];
      for (const ImageTrim* end : {&trim, &image_.trims()[trim.next]}) {
        for (int axis = 0; axis < 3; ++axis) {
          const double x = end->start[axis] - middle_[axis];
          if (!(x >= static_cast<double>(node.low[axis][place]) && x <= static_cast<double>(node.high[axis][place])))
            return false;
        }
      }
    }
    return run.node == index;
  }

  const DesignImage& image_;
  Vec3 middle_;
  std::array<Visit, 3 * kMaxTreeDepth + 4> pending_;
  std::size_t size_ = 0, leaves_ = 0, runs_ = 0;
};

}  // namespace

bool tree_valid(const DesignImage& image) { return TreeCheck(image).run(); }

}  // namespace bladefit
