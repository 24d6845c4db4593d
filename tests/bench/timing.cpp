#include "tests/bench/timing.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <ctime>

namespace bladefit::bench {
namespace {

/// A chain of dependent multiply-adds: the same work on every machine and in every version. Returns seconds a link.
double calibrate() {
  constexpr int kLinks = 100000;
  volatile double seed = 0.75;
  const double slope = seed;
  double x = 1.0;
  const double begin = processor_seconds();
  for (int k = 0; k < kLinks; ++k) x = x * slope + 0.25;
  const double end = processor_seconds();
  seed = x;
  return (end - begin) / kLinks;
}

}  // namespace

double processor_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<Timing> timed_in_turn(const std::vector<Contestant>& contestants, const Effort& effort) {
  std::vector<Timing> timings(contestants.size());
  std::vector<double> used(contestants.size(), 0.0);
  for (int round = 0; round < effort.most; ++round) {
    for (std::size_t k = 0; k < contestants.size(); ++k) {
      if (round >= effort.least && used[k] > effort.seconds) continue;
      if (round == 0) std::fprintf(stderr, "    %s\n", contestants[k].name.c_str());
      if (contestants[k].prepare) contestants[k].prepare();
      timings[k].calibration.push_back(calibrate());
      const double begin = processor_seconds();
      contestants[k].run();
      timings[k].seconds.push_back(processor_seconds() - begin);
      timings[k].calibration.push_back(calibrate());
      used[k] += timings[k].seconds.back();
    }
  }
  return timings;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double least(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

double ratio(const Timing& timing, const Timing& base) {
  const auto rounds = static_cast<std::ptrdiff_t>(std::min(timing.seconds.size(), base.seconds.size()));
  return median({timing.seconds.begin(), timing.seconds.begin() + rounds}) /
         median({base.seconds.begin(), base.seconds.begin() + rounds});
}

double spread(const std::vector<double>& values) {
  return (*std::max_element(values.begin(), values.end()) - least(values)) / median(values);
}

}  // namespace bladefit::bench
