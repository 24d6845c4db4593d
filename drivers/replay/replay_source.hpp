#pragma once
#include <string>
#include <vector>

#include "drivers/replay/replay_settings.hpp"
#include "drivers/source/probe_source.hpp"

namespace bladefit {

/// Points of a CSV file, as fast as they are asked for. The run id is a check sum of the points, so that a session that
/// is resumed on another file is noticed.
class ReplaySource final : public ProbeSource {
 public:
  explicit ReplaySource(ReplaySettings settings) : settings_(std::move(settings)) {}

  /// bad_input: a file that read_points_csv() refuses, or one with fewer than `after` points.
  [[nodiscard]] Failure open(std::uint32_t after, std::uint32_t run_id) override;
  [[nodiscard]] std::size_t poll(std::span<ProbePoint> points, std::chrono::milliseconds timeout) override;
  void acknowledge(std::uint32_t) override {}
  void close() override {}
  [[nodiscard]] const SourceStatus& status() const override { return status_; }

 private:
  ReplaySettings settings_;
  std::vector<ProbePoint> points_;
  std::size_t next_ = 0;
  SourceStatus status_;
};

}  // namespace bladefit
