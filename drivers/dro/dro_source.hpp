#pragma once
#include <string>

#include "drivers/dro/axis_gatherer.hpp"
#include "drivers/dro/dro_settings.hpp"
#include "drivers/dro/readout_format.hpp"
#include "drivers/serial/lasting_port.hpp"
#include "drivers/source/point_queue.hpp"
#include "drivers/source/probe_source.hpp"

namespace bladefit {

/// A machine that merely prints its position, a line for each point or for each axis. Nothing can be asked for again,
/// so a line that cannot be read, or a lost link, is a loss. Points are numbered here; run id and end are unknown.
class DroSource final : public ProbeSource {
 public:
  DroSource(const DroSettings& settings, std::string name);

  [[nodiscard]] Failure open(std::uint32_t after, std::uint32_t run_id) override;
  [[nodiscard]] bool tells_end() const override { return false; }
  [[nodiscard]] std::size_t poll(std::span<ProbePoint> points, std::chrono::milliseconds timeout) override;
  void acknowledge(std::uint32_t) override {}
  void close() override { port_->close(); }
  [[nodiscard]] const SourceStatus& status() const override { return status_; }

 private:
  using Clock = std::chrono::steady_clock;

  void step(Clock::time_point until);
  void link_made();
  void reconnect(Clock::time_point until);
  void link_lost();
  void bytes_came(std::string_view bytes);
  void silence();
  void take(char byte);
  void take_line();
  void line_lost(const std::string& what, bool perhaps_cut);
  void sort_out(const std::vector<DroPoint>& points, DroOutcome outcome);
  void deliver(const DroPoint& point);

  const DroSettings settings_;
  const std::string name_;
  SourceStatus status_;
  LastingPort port_;
  AxisGatherer gatherer_;
  ReadoutFormat format_;
  PointQueue points_;
  std::string line_;
  std::string line_fault_;  ///< why the line under way is none, whatever comes of it; empty = nothing is wrong so far
  bool first_line_ = true;  ///< since the port was opened: its beginning may be missing
  bool from_silence_ = false;  ///< the port was silent after it was opened, so that the first line has its beginning
  Clock::time_point last_byte_{};  ///< or when the port was opened
  std::uint32_t next_ = 1;
};

}  // namespace bladefit
