#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace bladefit {

/// Which of a number of things refers to which: k refers to targets[first[k]] .. targets[first[k + 1] - 1].
struct ReferenceGraph {
  std::vector<std::size_t> first = {0};
  std::vector<std::uint32_t> targets;

  [[nodiscard]] std::size_t size() const { return first.size() - 1; }
};

/// A reference, as its place among the targets, that closes a circle; nothing where there is none. Depth first with a
/// stack of its own: chains may be as long as a file. Cost: linear.
[[nodiscard]] std::optional<std::size_t> find_circle(const ReferenceGraph& graph);

}  // namespace bladefit
