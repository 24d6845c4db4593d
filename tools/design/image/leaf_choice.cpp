#include "tools/design/image/leaf_choice.hpp"

#include <algorithm>
#include <queue>

namespace bladefit {
namespace {

struct Cut {
  double gain;
  std::size_t span, candidate;

  /// Of two that gain as much the earlier one comes first, so that every run chooses alike.
  bool operator<(const Cut& other) const {
    if (gain != other.gain) return gain < other.gain;
    return span != other.span ? span > other.span : candidate > other.candidate;
  }
};

std::vector<std::size_t> uncut(const LeafTree& tree, const std::vector<bool>& cut) {
  std::vector<std::size_t> leaves, pending{0};
  while (!pending.empty()) {
    const std::size_t k = pending.back();
    pending.pop_back();
    if (cut[k]) {
      pending.push_back(tree[k].halves + 1);
      pending.push_back(tree[k].halves);
    } else if (tree[k].on_face) {
      leaves.push_back(k);
    }
  }
  return leaves;
}

}  // namespace

std::size_t fewest_leaves(const std::vector<LeafTree>& trees) {
  return static_cast<std::size_t>(
      std::count_if(trees.begin(), trees.end(), [](const LeafTree& tree) { return tree.front().on_face; }));
}

LeafChoice choose_leaves(const std::vector<LeafTree>& trees, std::size_t most) {
  std::priority_queue<Cut> pending;
  std::vector<std::vector<bool>> cut;
  const auto offer = [&](std::size_t span, std::size_t k) {
    const LeafCandidate& c = trees[span][k];
    if (c.on_face && c.gain > 0) pending.push({c.gain, span, k});
  };
  for (std::size_t span = 0; span < trees.size(); ++span) {
    cut.emplace_back(trees[span].size(), false);
    offer(span, 0);
  }
  std::size_t leaves = fewest_leaves(trees);
  while (!pending.empty()) {
    const auto [gain, span, k] = pending.top();
    pending.pop();
    const std::size_t first = trees[span][k].halves;
    const std::size_t after =
        leaves - 1 + (trees[span][first].on_face ? 1 : 0) + (trees[span][first + 1].on_face ? 1 : 0);
    if (after > most) continue;
    leaves = after;
    cut[span][k] = true;
    offer(span, first);
    offer(span, first + 1);
  }
  LeafChoice choice;
  for (std::size_t span = 0; span < trees.size(); ++span) choice.push_back(uncut(trees[span], cut[span]));
  return choice;
}

}  // namespace bladefit
