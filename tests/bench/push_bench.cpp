// The time of each push() over a whole stream: median, p99.9 and the true maximum.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>

#include "tests/unit/core_fixtures.hpp"

namespace bladefit::testing {
namespace {

/// The least of several runs for each push, so that what another program did meanwhile is left out; the maximum over
/// all pushes of all runs is reported beside it.
void push(benchmark::State& state, const char* name) {
  using Clock = std::chrono::steady_clock;
  const ReferenceCase c = read_case(name);
  const std::vector<ProbePoint> points = points_of(c, "full");
  OwnedLocalizer localizer(reference_design(name).image(), config_of(c, points.size()));
  std::vector<double> least(points.size(), 1e30);
  double largest = 0;
  for (auto _ : state) {
    localizer->reset();
    Verdict verdict;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Clock::time_point begin = Clock::now();
      const Status status = localizer->push(points[k], verdict);
      const double time = std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
      if (!succeeded(status)) state.SkipWithError("refused");
      least[k] = std::min(least[k], time);
      largest = std::max(largest, time);
    }
  }
  std::sort(least.begin(), least.end());
  const auto quantile = [&](double q) {
    return least[static_cast<std::size_t>(q * static_cast<double>(least.size() - 1))];
  };
  state.counters["median_us"] = quantile(0.5);
  state.counters["p99.9_us"] = quantile(0.999);
  state.counters["max_us"] = least.back();
  state.counters["max_any_run_us"] = largest;
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
}
BENCHMARK_CAPTURE(push, arl_fan, "arl_fan")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(push, dtmb4119, "dtmb4119")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bladefit::testing
