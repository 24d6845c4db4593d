#pragma once
#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware_bridge/host/fit/distance_sweep.hpp"
#include "firmware_bridge/host/fit/fit_stream.hpp"
#include "firmware_bridge/host/fit/recent_alarms.hpp"
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
  using Clock = std::chrono::steady_clock;
  friend class FitStream;  // Its follow() reports to the next three.

  void judged(const Verdict& verdict);
  void settled();
  void forgotten();

  void take(const StreamEvent& event);
  [[nodiscard]] bool keep_place(std::uint32_t sequence);
  void publish(const FitOutput& output);
  void publish_revisions();
  void publish_figures();
  void report_again(std::span<const std::uint32_t> sequences, FitOutput::Kind kind);
  void report_distances();

  FitStream stream_;
  StreamLosses losses_;
  HostShared& shared_;
  LatencyHistogram latency_;
  std::vector<std::uint32_t> stored_sequences_;  ///< rising; never grows beyond what was reserved
  RecentAlarms alarms_;
  DistanceSweep sweep_;
  std::uint32_t revision_ = 0;  ///< of the fit, when its figures were published last
  std::uint32_t events_since_figures_ = 0;
  Clock::time_point taken_at_{};  ///< when the event under way came out of the ring
};

}  // namespace bladefit
