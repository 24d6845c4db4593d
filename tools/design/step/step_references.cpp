#include "tools/design/step/step_references.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tools/design/text/reference_circle.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {

void StepReferences::define(std::uint32_t number, std::size_t line) {
  instances_.push_back({number, line, references_.size()});
}

void StepReferences::refer(std::uint32_t number, std::size_t line) {
  if (!instances_.empty()) references_.push_back({number, line});  // the header section has no instances
}

void StepReferences::check() const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> places;
  places.reserve(instances_.size());
  for (std::uint32_t k = 0; k < instances_.size(); ++k) places.emplace_back(instances_[k].number, k);
  std::sort(places.begin(), places.end());
  for (std::size_t k = 1; k < places.size(); ++k) {
    if (places[k].first != places[k - 1].first) continue;
    fail(instances_[places[k].second].line, fmt::format("#{} is given a second time, first on line {}", places[k].first,
                                                        instances_[places[k - 1].second].line));
  }
  ReferenceGraph graph;
  for (std::size_t k = 1; k < instances_.size(); ++k) graph.first.push_back(instances_[k].first_reference);
  if (!instances_.empty()) graph.first.push_back(references_.size());
  for (const Reference& reference : references_) {
    const auto found = std::lower_bound(places.begin(), places.end(), std::pair{reference.number, std::uint32_t{0}});
    if (found == places.end() || found->first != reference.number) {
      fail(reference.line, fmt::format("#{} is referred to but not in the file", reference.number));
    }
    graph.targets.push_back(found->second);
  }
  if (const auto circle = find_circle(graph)) {
    fail(references_[*circle].line,
         fmt::format("#{} refers to itself by way of this line", references_[*circle].number));
  }
}

void StepReferences::fail(std::size_t line, const std::string& what) const {
  throw ToolError(fmt::format("{}: line {}: {}; export the design again", file_, line, what));
}

}  // namespace bladefit
