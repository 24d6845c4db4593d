#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "firmware_bridge/host/fit/fit_stream.hpp"
#include "firmware_bridge/host/threads/host_shared.hpp"
#include "firmware_bridge/host/threads/latency_histogram.hpp"

namespace bladefit {

/// Judges what comes through HostShared::to_fit. Runs in the fit thread: it takes no lock and allocates nothing; it
/// waits only when there is no point, or when the publication thread is thousands of verdicts behind.
class FitWorker {
 public:
  /// `capacity`: points that keep a place in the localizer.
  FitWorker(Localizer& localizer, std::uint32_t capacity, std::uint32_t path_refine_points, HostShared& shared)
      : stream_(localizer, path_refine_points), shared_(shared) {
    stored_sequences_.reserve(capacity);
  }

  /// Runs until the end of the stream; then the fit has settled and HostShared::fit_done is set.
  void run();

 private:
  void judge(const StreamEvent& event);
  void judge_point(const ProbePoint& point);
  void publish(const FitOutput& output);
  void publish_revisions();
  void settle();
  void publish_figures();
  void publish_listed();

  FitStream stream_;
  HostShared& shared_;
  LatencyHistogram latency_;
  std::vector<std::uint32_t> stored_sequences_;  // never grows beyond what was reserved
  std::uint32_t events_since_figures_ = 0;
  // The leading-edge points that were told as out last: those that panels list.
  std::array<std::uint32_t, 16> listed_{};
  std::size_t listed_next_ = 0;
};

}  // namespace bladefit
