// Evaluation and nearest points, at the feet of real measured points.

#include <benchmark/benchmark.h>

#include "core/geometry/global_projection.hpp"
#include "tests/unit/core_fixtures.hpp"

namespace bladefit::testing {
namespace {

/// Measured points of a case at its start pose, with their feet.
struct Queries {
  const CompiledDesign& design;
  std::vector<ProjectionQuery> queries;
  std::vector<Projection> feet;
};

const Queries& queries_of(const std::string& name) {
  static std::map<std::string, Queries> all;
  const auto known = all.find(name);
  if (known != all.end()) return known->second;
  const ReferenceCase c = read_case(name);
  Queries made{reference_design(name), {}, {}};
  for (const ProbePoint& point : points_of(c, "full")) {
    ProjectionQuery query;
    query.point = Vec3(point.position.data());
    if (c.use_approach) query.approach = Vec3(point.approach.data());
    made.queries.push_back(query);
    made.feet.push_back(project_global(made.design.surface(), query, nullptr).nearest);
  }
  return all.emplace(name, std::move(made)).first->second;
}

/// Runs `body` on one query after the other and reports the time of one.
template <class F>
void for_each_query(benchmark::State& state, const char* name, F body) {
  const Queries& q = queries_of(name);
  std::size_t k = 0;
  for (auto _ : state) {
    body(q, k);
    if (++k == q.queries.size()) k = 0;
  }
}

void evaluate(benchmark::State& state, const char* name) {
  for_each_query(state, name, [](const Queries& q, std::size_t k) {
    benchmark::DoNotOptimize(q.design.surface().evaluate(q.feet[k].place));
  });
}
BENCHMARK_CAPTURE(evaluate, arl_fan, "arl_fan");
BENCHMARK_CAPTURE(evaluate, dtmb4119, "dtmb4119");

/// From a foot 1e-3 mm away, as after a small motion of the pose.
void nearest_warm(benchmark::State& state, const char* name) {
  for_each_query(state, name, [](const Queries& q, std::size_t k) {
    const Vec3 r = q.queries[k].point + Vec3(6e-4, -6e-4, 5e-4);
    benchmark::DoNotOptimize(project_local(q.design.surface(), r, q.feet[k].place));
  });
}
BENCHMARK_CAPTURE(nearest_warm, arl_fan, "arl_fan");
BENCHMARK_CAPTURE(nearest_warm, dtmb4119, "dtmb4119");

/// Global, with nothing known.
void nearest_cold(benchmark::State& state, const char* name) {
  for_each_query(state, name, [&](const Queries& q, std::size_t k) {
    const GlobalProjection found = project_global(q.design.surface(), q.queries[k], nullptr);
    if (!found.proven) state.SkipWithError("not proven");
    benchmark::DoNotOptimize(found);
  });
}
BENCHMARK_CAPTURE(nearest_cold, arl_fan, "arl_fan");
BENCHMARK_CAPTURE(nearest_cold, dtmb4119, "dtmb4119");
BENCHMARK_CAPTURE(nearest_cold, pnsy_sub, "pnsy_sub");

/// Global from a foot that is right already: what the proof alone costs.
void nearest_recheck(benchmark::State& state, const char* name) {
  for_each_query(state, name, [](const Queries& q, std::size_t k) {
    benchmark::DoNotOptimize(project_global(q.design.surface(), q.queries[k], &q.feet[k]));
  });
}
BENCHMARK_CAPTURE(nearest_recheck, arl_fan, "arl_fan");
BENCHMARK_CAPTURE(nearest_recheck, dtmb4119, "dtmb4119");

}  // namespace
}  // namespace bladefit::testing
