#include "firmware_bridge/host/threads/latency_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace bladefit {

void LatencyHistogram::add(std::int64_t nanoseconds) {
  const double octaves = std::log2(std::max(static_cast<double>(nanoseconds), kLeast_ns) / kLeast_ns);
  const auto bin = static_cast<std::size_t>(octaves * kBinsPerOctave);
  ++counts_[std::min(bin, kBins - 1)];
  ++total_;
}

double LatencyHistogram::quantile_us(double fraction) const {
  if (total_ == 0) return 0;
  const auto wanted = static_cast<std::uint64_t>(std::ceil(fraction * static_cast<double>(total_)));
  std::uint64_t below = 0;
  std::size_t bin = 0;
  while (bin + 1 < kBins && (below += counts_[bin]) < wanted) ++bin;
  constexpr double kNanosecondsPerMicrosecond = 1000;
  return kLeast_ns * std::exp2(static_cast<double>(bin + 1) / kBinsPerOctave) / kNanosecondsPerMicrosecond;
}

}  // namespace bladefit
