#include "tools/batch/whole_fit.hpp"

#include <stdexcept>

namespace bladefit {

void refine_all(Localizer& localizer, std::size_t points) {
  localizer.conclude();
  // The refinement has its own cap on sweeps, so this ends.
  while (localizer.refine(static_cast<std::uint32_t>(points)) == Status::more_work) {
  }
}

std::vector<Verdict> verdicts_of(const Localizer& localizer, const std::vector<ProbePoint>& points) {
  std::vector<Verdict> verdicts(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (localizer.verdict_of(points[i].sequence, verdicts[i]) != Status::ok)
      throw std::logic_error("a staged point is missing");
  }
  return verdicts;
}

}  // namespace bladefit
