#include "tools/design/image/tree_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace bladefit {
namespace {

/// Of a node. Of more boxes than that a multiple is parted off, so that few nodes have places left.
constexpr std::size_t kChildren = 4;

/// From this depth on boxes are parted at the median, so that the logarithm of their number bounds what is left.
constexpr int kUnevenDepth = 16;

using Members = std::span<std::uint32_t>;

void include(Box& box, const Box& other) {
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::min(box.min[axis], other.min[axis]);
    box.max[axis] = std::max(box.max[axis], other.max[axis]);
  }
}

double half_area(const Box& box) {
  const double x = box.max[0] - box.min[0], y = box.max[1] - box.min[1], z = box.max[2] - box.min[2];
  return x * y + y * z + z * x;
}

/// Largest coordinate of single precision below `x`, about the middle, or smallest above it.
float coordinate_below(double x) {
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}
float coordinate_above(double x) {
  return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

class TreeBuilder {
 public:
  TreeBuilder(const std::vector<Box>& boxes, const Box& whole) : boxes_(boxes), whole_(whole) {}

  std::vector<ImageNode> run() {
    std::vector<std::uint32_t> members(boxes_.size());
    std::iota(members.begin(), members.end(), 0U);
    append(members, 0);
    return std::move(nodes_);
  }

 private:
  [[nodiscard]] Box around(Members members) const {
    Box box = boxes_[members.front()];
    for (const std::uint32_t member : members) include(box, boxes_[member]);
    return box;
  }

  /// Sorts by the box centres along `axis`; equal centres by number, so that every run gives the same order.
  void sort_along(int axis, Members members) const {
    std::sort(members.begin(), members.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double centre_a = boxes_[a].min[axis] + boxes_[a].max[axis];
      const double centre_b = boxes_[b].min[axis] + boxes_[b].max[axis];
      return centre_a != centre_b ? centre_a < centre_b : a < b;
    });
  }

  struct Cut {
    double cost = std::numeric_limits<double>::infinity();
    std::size_t first = 0;  ///< members of the first part
  };
  /// The cheapest cut of members that are in order.
  [[nodiscard]] Cut cheapest_cut(Members members) const {
    std::vector<double> area_behind(members.size());
    Box box = boxes_[members.back()];
    for (std::size_t k = members.size(); k-- > 1;) {
      include(box, boxes_[members[k]]);
      area_behind[k] = half_area(box);
    }
    Cut best;
    box = boxes_[members.front()];
    for (std::size_t k = 1; k < members.size(); ++k) {
      include(box, boxes_[members[k - 1]]);
      if (members.size() > kChildren && k % kChildren != 0) continue;
      const double cost =
          static_cast<double>(k) * half_area(box) + static_cast<double>(members.size() - k) * area_behind[k];
      if (cost < best.cost) best = {cost, k};
    }
    return best;
  }

  /// Puts the members in order and says how many are in the first of two parts.
  [[nodiscard]] std::size_t part(Members members, int depth) const {
    int best_axis = 0;
    Cut best;
    for (int axis = 0; axis < 3; ++axis) {
      sort_along(axis, members);
      const Cut cut = cheapest_cut(members);
      if (cut.cost < best.cost) {
        best = cut;
        best_axis = axis;
      }
    }
    sort_along(best_axis, members);
    if (depth < kUnevenDepth) return best.first;
    const std::size_t half = members.size() / 2;
    return members.size() > kChildren ? (half + kChildren - 1) / kChildren * kChildren : half;
  }

  /// Parts the largest part again until there are four.
  [[nodiscard]] std::vector<Members> parted(Members members, int depth) const {
    std::vector<Members> parts{members};
    while (parts.size() < kChildren) {
      std::size_t largest = parts.size();
      double area = -1.0;
      for (std::size_t k = 0; k < parts.size(); ++k) {
        const bool whole_node = members.size() > kChildren && parts[k].size() <= kChildren;
        if (parts[k].size() < 2 || whole_node || half_area(around(parts[k])) <= area) continue;
        largest = k;
        area = half_area(around(parts[k]));
      }
      if (largest == parts.size()) break;
      const Members whole = parts[largest];
      const std::size_t first = part(whole, depth);
      parts[largest] = whole.first(first);
      parts.insert(parts.begin() + static_cast<std::ptrdiff_t>(largest) + 1, whole.subspan(first));
    }
    return parts;
  }

  void append(Members members, int depth) {
    const std::size_t self = nodes_.size();
    nodes_.emplace_back();
    const std::vector<Members> parts = parted(members, depth);
    for (std::size_t place = 0; place < kChildren; ++place) {
      if (place >= parts.size()) {
        set_empty(nodes_[self], place);
        continue;
      }
      set_box(around(parts[place]), nodes_[self], place);
      const bool leaf = parts[place].size() == 1;
      nodes_[self].child[place] = leaf ? kLeafChild | parts[place].front() : static_cast<std::uint32_t>(nodes_.size());
      if (!leaf) append(parts[place], depth + 1);
    }
  }

  void set_box(const Box& box, ImageNode& node, std::size_t place) const {
    for (int axis = 0; axis < 3; ++axis) {
      const double middle = 0.5 * (whole_.min[axis] + whole_.max[axis]);
      node.low[axis][place] = coordinate_below(box.min[axis] - middle);
      node.high[axis][place] = coordinate_above(box.max[axis] - middle);
    }
  }

  static void set_empty(ImageNode& node, std::size_t place) {
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis][place] = std::numeric_limits<float>::infinity();
      node.high[axis][place] = -std::numeric_limits<float>::infinity();
    }
    node.child[place] = kNoChild;
  }

  const std::vector<Box>& boxes_;
  Box whole_;
  std::vector<ImageNode> nodes_;
};

}  // namespace

Box box_around(const std::vector<Box>& boxes) {
  Box whole = boxes.front();
  for (const Box& box : boxes) include(whole, box);
  return whole;
}

std::vector<ImageNode> build_bounding_tree(const std::vector<Box>& boxes, const Box& whole) {
  return TreeBuilder(boxes, whole).run();
}

}  // namespace bladefit
