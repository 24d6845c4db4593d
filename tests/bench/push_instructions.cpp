// Pushes the first COUNT points of dtmb4119: instructions.sh counts what the last 50 of them cost.

#include <cstdio>
#include <cstdlib>

#include "tests/unit/core_fixtures.hpp"

int main(int argc, char** argv) {
  using namespace bladefit;
  using namespace bladefit::testing;
  const std::size_t count = argc == 2 ? std::strtoul(argv[1], nullptr, 10) : 0;
  const ReferenceCase c = read_case("dtmb4119");
  const std::vector<ProbePoint> points = points_of(c, "full");
  if (count == 0 || count > points.size()) {
    std::fprintf(stderr, "usage: push_instructions COUNT (1 to %zu points)\n", points.size());
    return 2;
  }
  OwnedLocalizer localizer(reference_design("dtmb4119").image(), config_of(c, points.size()));
  Verdict verdict;
  for (std::size_t k = 0; k < count; ++k) {
    if (!succeeded(localizer->push(points[k], verdict))) return 1;
  }
  std::printf("%u points, %u degrees of freedom\n", localizer->fit().points, localizer->fit().determined);
  return 0;
}
