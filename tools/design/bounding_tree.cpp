#include "tools/design/bounding_tree.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace bladefit {
namespace {

ImageNode enclosing_node(const std::vector<Box>& boxes, std::span<const std::uint32_t> members) {
  ImageNode node{};
  for (int axis = 0; axis < 3; ++axis) {
    node.box_min[axis] = boxes[members.front()].min[axis];
    node.box_max[axis] = boxes[members.front()].max[axis];
    for (const std::uint32_t member : members) {
      node.box_min[axis] = std::min(node.box_min[axis], boxes[member].min[axis]);
      node.box_max[axis] = std::max(node.box_max[axis], boxes[member].max[axis]);
    }
  }
  return node;
}

int longest_axis(const ImageNode& node) {
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis) {
    const double length = node.box_max[axis] - node.box_min[axis];
    if (length > node.box_max[longest] - node.box_min[longest]) longest = axis;
  }
  return longest;
}

/// Sorts by the box centres along `axis`; equal centres by number, so that every run gives the same order.
void sort_along(const std::vector<Box>& boxes, int axis, std::span<std::uint32_t> members) {
  std::sort(members.begin(), members.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double centre_a = boxes[a].min[axis] + boxes[a].max[axis];
    const double centre_b = boxes[b].min[axis] + boxes[b].max[axis];
    return centre_a != centre_b ? centre_a < centre_b : a < b;
  });
}

void append_subtree(const std::vector<Box>& boxes, std::span<std::uint32_t> members, std::vector<ImageNode>& nodes) {
  const std::size_t self = nodes.size();
  nodes.push_back(enclosing_node(boxes, members));
  if (members.size() == 1) {
    nodes[self].leaf = members.front();
    return;
  }
  sort_along(boxes, longest_axis(nodes[self]), members);
  const std::size_t half = members.size() / 2;
  append_subtree(boxes, members.first(half), nodes);
  nodes[self].right = static_cast<std::uint32_t>(nodes.size());
  append_subtree(boxes, members.subspan(half), nodes);
}

}  // namespace

std::vector<ImageNode> build_bounding_tree(const std::vector<Box>& boxes) {
  std::vector<std::uint32_t> members(boxes.size());
  std::iota(members.begin(), members.end(), 0U);
  std::vector<ImageNode> nodes;
  nodes.reserve(2 * boxes.size() - 1);
  append_subtree(boxes, members, nodes);
  return nodes;
}

}  // namespace bladefit
