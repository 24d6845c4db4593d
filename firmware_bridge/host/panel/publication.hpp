#pragma once
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>

#include "core/inspection/tolerance_map.hpp"
#include "firmware_bridge/host/blade/blade_layout.hpp"
#include "firmware_bridge/host/feed/point_feed.hpp"
#include "firmware_bridge/host/panel/conclusion.hpp"
#include "firmware_bridge/host/panel/panel_server.hpp"
#include "firmware_bridge/host/panel/tally.hpp"
#include "firmware_bridge/host/threads/host_shared.hpp"

namespace bladefit {

/// Keeps the newest verdicts and figures and serves them to panels. Runs in the publication thread; nothing in it
/// waits for a disk or a client, so that a verdict is readable on the panel as soon as it is there.
class Publication {
 public:
  /// `layout`, `server`, `feed` and `shared` must outlive it. `source`: the name of what the points come from. `feed`,
  /// where there is one, gets every verdict.
  Publication(const ToleranceMap& tolerance, const BladeLayout& layout, const std::string& source, PanelServer& server,
              PointFeed* feed, HostShared& shared);

  /// Runs until HostShared::panel_closed is set and the fit is done; then, up to a second longer, until the clients
  /// that ask have seen the last state.
  void run();

  /// What the panel shows now. Any thread.
  [[nodiscard]] PanelState shown();

  /// Does what a coil of the panel does, whether or not coils may be written. Any thread.
  void press(const PanelCommands& commands);

  /// What the session came to, with what was found against its fit elsewhere: its verdict stands
  /// instead of that which follows from counts and fit. `judged_again`, where there is one, counts every point at the
  /// final pose. Any thread.
  void conclude(const Conclusion& conclusion, std::shared_ptr<const Tally> judged_again);

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] const Tally& tally() const { return common_.judged_again ? *common_.judged_again : tally_; }
  [[nodiscard]] bool take_news();
  void show();
  void linger();
  void take(const FitOutput& output);
  void update_state();
  void update_counts();
  void update_fit();
  void update_verdict();
  void update_last();
  void update_places();
  void update_link();
  void update_blade();
  [[nodiscard]] SessionState session_state();
  [[nodiscard]] std::uint16_t alarms() const;
  void follow(const PanelCommands& commands);
  void follow_others();

  ToleranceMap tolerance_;
  const BladeLayout& layout_;
  PanelServer& server_;
  PointFeed* feed_;
  HostShared& shared_;
  Tally tally_;
  FitFigures figures_;
  LinkFigures link_;
  PanelState state_;
  Verdict last_;  ///< of the newest point
  /// Counts when the operator acknowledged the alarms last.
  struct Acknowledged {
    std::uint64_t times_out = 0, losses = 0;
  } acknowledged_;
  bool pressed_ = false;  ///< a command came since the last update
  /// Of the start, and of the last updates.
  struct Times {
    Clock::time_point start = Clock::now(), state{}, blade{};
  } times_;
  PanelImage image_;
  /// What other threads read or write.
  struct Shared {
    std::mutex mutex;
    PanelState shown;
    std::optional<Conclusion> concluded;
    std::shared_ptr<const Tally> judged_again;
    std::optional<PanelCommands> pressed;
  } common_;
};

}  // namespace bladefit
