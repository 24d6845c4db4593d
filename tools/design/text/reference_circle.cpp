#include "tools/design/text/reference_circle.hpp"

#include <utility>

namespace bladefit {

std::optional<std::size_t> find_circle(const ReferenceGraph& graph) {
  enum class State : std::uint8_t { fresh, open, done };
  std::vector<State> states(graph.size(), State::fresh);
  std::vector<std::pair<std::uint32_t, std::size_t>> stack;
  const auto enter = [&](std::uint32_t k) {
    states[k] = State::open;
    stack.emplace_back(k, graph.first[k]);
  };
  for (std::uint32_t root = 0; root < graph.size(); ++root) {
    if (states[root] == State::fresh) enter(root);
    while (!stack.empty()) {
      auto& [k, next] = stack.back();
      if (next == graph.first[k + 1]) {
        states[k] = State::done;
        stack.pop_back();
        continue;
      }
      const std::size_t reference = next++;
      const std::uint32_t target = graph.targets[reference];
      if (states[target] == State::open) return reference;
      if (states[target] == State::fresh) enter(target);
    }
  }
  return std::nullopt;
}

}  // namespace bladefit
