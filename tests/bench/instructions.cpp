// The work that instructions.sh counts: each part is done between two requests to callgrind, which then writes what it
// has counted under the part's name. Without callgrind the requests do nothing.

#include <valgrind/callgrind.h>

#include <cstdio>
#include <cstdlib>

#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/localizer_fixtures.hpp"

namespace bladefit::bench {
namespace {

using namespace bladefit::testing;

/// A wrong answer makes a count worthless.
void require(bool good, const char* what) {
  if (good) return;
  std::fprintf(stderr, "instructions: %s\n", what);
  std::exit(1);
}

/// Counts what `work` does. `name` ends in how many parts the count is to be divided by: "push_at_100/50".
template <class Work>
void counted(const char* name, Work work) {
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
  work();
  CALLGRIND_DUMP_STATS_AT(name);
  CALLGRIND_STOP_INSTRUMENTATION;
}

void count_nearest() {
  const Surface& surface = reference_design("arl_fan").surface();
  std::vector<ProjectionQuery> queries;
  std::vector<Projection> feet;
  for (const ProbePoint& point : points_of(read_case("arl_fan"), "106")) {
    queries.emplace_back().point = Vec3(point.position.data());
    feet.push_back(project_global(surface, queries.back(), nullptr).nearest);
  }
  const Vec3 apart(6e-4, -6e-4, 5e-4);
  bool good = true;
  counted("nearest_warm/106", [&] {
    for (std::size_t k = 0; k < queries.size(); ++k) {
      good = project_local(surface, queries[k].point + apart, feet[k].place).converged && good;
    }
  });
  counted("nearest_cold/106", [&] {
    for (const ProjectionQuery& query : queries) good = project_global(surface, query, nullptr).proven && good;
  });
  require(good, "a nearest point was not found");
}

/// Means over the 50 pushes that end at 100 and at 2000 points: one alone depends on which points its refresh meets.
void count_pushes() {
  const ReferenceCase c = read_case("dtmb4119");
  const std::vector<ProbePoint> points = points_of(c, "full");
  OwnedLocalizer localizer(reference_design("dtmb4119").image(), config_of(c, points.size()));
  std::size_t next = 0;
  const auto push_to = [&](std::size_t end) {
    Verdict verdict;
    for (; next < end; ++next) require(succeeded(localizer->push(points[next], verdict)), "a point was refused");
  };
  push_to(50);
  counted("push_at_100/50", [&] { push_to(100); });
  push_to(1950);
  counted("push_at_2000/50", [&] { push_to(2000); });
}

void count_fit(const char* name, FitMode mode) {
  const ReferenceCase c = read_case("arl_fan");
  const std::vector<ProbePoint> points = points_of(c, "full");
  LocalizerConfig config = config_of(c, points.size());
  config.mode = mode;
  config.regions = RegionPolicy::fixed;
  config.further_starts = 0;
  OwnedLocalizer localizer(reference_design("arl_fan").image(), config);
  counted(name, [&] {
    for (const ProbePoint& point : points) require(succeeded(localizer->stage(point)), "a point was refused");
    localizer->conclude();
    require(refine_fully(*localizer) == Status::ok, "a fit did not converge");
  });
}

}  // namespace
}  // namespace bladefit::bench

int main() {
  using namespace bladefit;
  bench::count_nearest();
  bench::count_pushes();
  bench::count_fit("least_squares_arl_fan_1261/1", FitMode::least_squares);
  bench::count_fit("min_tolerance_arl_fan_1261/1", FitMode::min_tolerance);
  return 0;
}
