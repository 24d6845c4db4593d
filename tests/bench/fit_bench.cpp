// Whole least-squares fits from cold: every point projected globally, then refined until every foot is proven.

#include <benchmark/benchmark.h>

#include <cmath>

#include "tests/unit/core_fixtures.hpp"

namespace bladefit::testing {
namespace {

/// The rms of the case's reference solution [mm]: a fast wrong answer is no answer.
double reference_rms(const ReferenceCase& c, const std::string& subset) {
  const nlohmann::json truth = read_json(c.folder / "truth" / (subset + ".json"));
  return truth.at("least_squares").at("rms").get<double>() * c.mm_per_unit;
}

void localize(benchmark::State& state, const char* name) {
  const ReferenceCase c = read_case(name);
  const std::vector<ProbePoint> points = points_of(c, "full");
  const double rms = reference_rms(c, "full");
  OwnedLocalizer localizer(reference_design(name).image(), config_of(c, points.size()));
  for (auto _ : state) {
    localizer->reset();
    for (const ProbePoint& point : points) benchmark::DoNotOptimize(localizer->stage(point));
    localizer->conclude();
    if (refine_fully(*localizer) != Status::ok) state.SkipWithError("not converged");
    if (std::abs(localizer->fit().rms_mm - rms) > 1e-8 * rms) state.SkipWithError("not the reference solution");
  }
  state.counters["points"] = static_cast<double>(points.size());
}
BENCHMARK_CAPTURE(localize, arl_fan_1261, "arl_fan")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(localize, dtmb4119_2000, "dtmb4119")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(localize, pnsy_sub_3215, "pnsy_sub")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bladefit::testing
