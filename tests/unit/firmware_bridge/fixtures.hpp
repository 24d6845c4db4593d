#pragma once
#include <array>
#include <atomic>
#include <cstdlib>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/geometry/surface/design_image.hpp"
#include "core/localizer.hpp"
#include "drivers/replay/points_csv.hpp"
#include "drivers/source/probe_source.hpp"
#include "firmware_bridge/host/host.hpp"
#include "tests/support/reference_design.hpp"
#include "tests/support/scratch_folder.hpp"

namespace bladefit::testing {

/// The compiled blade of dtmb4119, 8-byte aligned.
inline const std::vector<std::byte>& blade_bytes() { return reference_design("dtmb4119").bytes(); }
inline const DesignImage& blade() { return reference_design("dtmb4119").image(); }

/// The first `count` measured points of the case.
inline std::vector<ProbePoint> measured_points(std::size_t count) {
  PointsFile file = read_points_csv(std::string(BLADEFIT_TEST_DATA) + "/dtmb4119/points.csv", {});
  if (file.error || file.points.size() < count) std::abort();
  file.points.resize(count);
  return file.points;
}

/// The fit of the tests: leading edge 0.1 mm, elsewhere 0.2 mm.
inline LocalizerConfig blade_config() {
  LocalizerConfig config;
  config.capacity = 4096;
  config.tolerance.boxes[0] = {0, 0.4, 0.6, 0.0, 1.0};
  config.tolerance.box_count = 1;
  config.tolerance.leading_edge_mm = 0.1;
  config.tolerance.rest_mm = 0.2;
  return config;
}

/// A session of these tests in `folder`: a panel at a free port, and an end when the device says so.
inline HostSettings settings_for(const std::string& folder) {
  HostSettings settings;
  settings.localizer = blade_config();
  settings.session_directory = folder;
  settings.panel.port = 0;
  settings.end_when_finished = true;
  return settings;
}

/// A device that delivers given points in portions of random length, and says that it is finished after them.
class ScriptedSource : public ProbeSource {
 public:
  explicit ScriptedSource(std::vector<ProbePoint> points, unsigned seed = 1)
      : points_(std::move(points)), seed_(seed) {}

  [[nodiscard]] Failure open(std::uint32_t after, std::uint32_t /*run_id*/) override {
    if (!refusal.empty()) return device_failure(refusal);
    while (next_ < points_.size() && points_[next_].sequence <= after) ++next_;
    opened_after = after;
    status_.link = LinkState::up;
    status_.run_id = run_id;
    status_.device_fault = device_fault;
    return {};
  }

  [[nodiscard]] std::size_t poll(std::span<ProbePoint> points, std::chrono::milliseconds timeout) override {
    const std::size_t end = std::min(points_.size(), stop_after);
    if (next_ >= end) {
      status_.finished = next_ == points_.size();
      if (later_run_id) status_.run_id = *later_run_id;
      status_.losses = losses;
      status_.last = last;
      status_.stopped = stopped;
      std::this_thread::sleep_for(timeout);
      return 0;
    }
    seed_ = seed_ * 1103515245U + 12345U;
    const std::size_t wanted = 1 + (seed_ >> 16U) % 7;
    const std::size_t count = std::min({wanted, end - next_, points.size()});
    for (std::size_t index = 0; index < count; ++index) points[index] = points_[next_++];
    return count;
  }

  void acknowledge(std::uint32_t sequence) override { acknowledged = sequence; }
  void close() override { closed = true; }
  [[nodiscard]] const SourceStatus& status() const override { return status_; }

  std::string refusal;  ///< open() fails with this
  std::uint32_t run_id = 7;
  std::optional<std::uint32_t> later_run_id;  ///< once it is silent it says that it is in this run
  std::size_t stop_after = SIZE_MAX;          ///< falls silent after so many points
  bool device_fault = false;
  std::atomic<std::uint64_t> losses{0};  ///< how many it tells of once it is silent
  std::uint32_t last = 0;                ///< and up to which record all others are given up
  std::string stopped;                   ///< and why it goes no further
  std::uint32_t opened_after = 0;
  std::uint32_t acknowledged = 0;
  bool closed = false;

 private:
  std::vector<ProbePoint> points_;
  std::size_t next_ = 0;
  unsigned seed_;
  SourceStatus status_;
};

/// A session's result with its points.
struct WholeResult : SessionResult {
  std::vector<ProbePoint> points;
  std::vector<Verdict> verdicts;  ///< verdicts[i] is that of points[i]
};

inline WholeResult finish_whole(Host& host) {
  struct Kept : JudgedPoints {
    void add(const ProbePoint& point, const Verdict& verdict) override {
      points.push_back(point);
      verdicts.push_back(verdict);
    }
    void clear() override {
      points.clear();
      verdicts.clear();
    }
    std::vector<ProbePoint> points;
    std::vector<Verdict> verdicts;
  } kept;
  WholeResult whole{host.finish(kept), {}, {}};
  whole.points = std::move(kept.points);
  whole.verdicts = std::move(kept.verdicts);
  return whole;
}

}  // namespace bladefit::testing
