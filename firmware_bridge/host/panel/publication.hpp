#pragma once
#include <chrono>

#include "core/inspection/shaft_axis.hpp"
#include "core/inspection/tolerance_map.hpp"
#include "firmware_bridge/host/panel/panel_server.hpp"
#include "firmware_bridge/host/panel/tally.hpp"
#include "firmware_bridge/host/threads/host_shared.hpp"

namespace bladefit {

/// Keeps the newest verdicts and figures and serves them to panels. Runs in the publication thread; nothing in it
/// waits for a disk or a client, so that a verdict is readable on the panel as soon as it is there.
class Publication {
 public:
  Publication(const ToleranceMap& tolerance, const ShaftAxis& axis, PanelServer& server, HostShared& shared);

  /// Runs until HostShared::panel_closed is set and the fit is done.
  void run();

 private:
  using Clock = std::chrono::steady_clock;
  void take_news();
  void take(const FitOutput& output);
  void update_state();
  void update_counts();
  void update_fit();
  void update_verdict();
  void update_last();
  void update_places();
  [[nodiscard]] SessionState session_state();
  [[nodiscard]] std::uint16_t alarms() const;
  void follow(const PanelCommands& commands);

  ToleranceMap tolerance_;
  ShaftAxis axis_;
  PanelServer& server_;
  HostShared& shared_;
  Tally tally_;
  FitFigures figures_;
  LinkFigures link_;
  PanelState state_;
  Verdict last_;  ///< of the newest point
  std::uint64_t acknowledged_times_out_ = 0;
  std::uint64_t acknowledged_losses_ = 0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace bladefit
