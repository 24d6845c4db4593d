#pragma once
#include <functional>
#include <memory>
#include <string>

#include "core/inspection/shaft_axis.hpp"
#include "core/localizer.hpp"
#include "drivers/source/probe_source.hpp"
#include "firmware_bridge/host/feed/point_feed.hpp"
#include "firmware_bridge/host/panel/conclusion.hpp"
#include "firmware_bridge/host/panel/panel_protocol.hpp"
#include "firmware_bridge/host/panel/panel_server.hpp"
#include "firmware_bridge/host/session_result.hpp"
#include "firmware_bridge/host/threads/host_shared.hpp"

namespace bladefit {

struct HostSettings {
  LocalizerConfig localizer;
  /// Made when it is missing, and removed again when nothing was put into it. A session in it is resumed.
  std::string session_directory;
  PanelServerSettings panel;
  bool feed = false;         ///< whether points and verdicts are kept for those who draw them
  ShaftAxis axis;            ///< from which the panel's radii are
  double tip_radius_mm = 0;  ///< R of r/R; 0 = the greatest radius of places all over the design
  std::string source_name;   ///< where the points come from, for the panel
  /// Stored points projected again when a path ends: bounds how long that makes the next point wait.
  std::uint32_t path_refine_points = 2048;
  bool end_when_finished = false;  ///< end when the device says that its program is finished
  /// End when no new point came for so long; a fault where the link is lost by then; 0 = never.
  std::chrono::milliseconds idle{0};
  std::uint32_t planned = 0;  ///< points that will come, where the source does not say; 0 = not known
};

/// The ready host: takes points from a source, keeps them in the journal of a session, judges them and serves a panel,
/// in four threads joined by rings:
///   acquisition   waits for the device, acknowledges what is on disk
///   journal       writes and synchronises the disk
///   fit           the localizer; no lock, no allocation
///   publication   tallies verdicts, serves panels
/// A session that was interrupted at any instant and is started again in the same folder ends with the same bits.
class Host {
 public:
  /// `design` (and the memory under it) and `source` must outlive the host.
  Host(HostSettings settings, const DesignImage& design, ProbeSource& source,
       std::function<void(const std::string&)> on_notice);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// Opens journal and panel and starts the threads. bad_input: the folder holds another session, or a setting is out
  /// of range; `device`: folder or port cannot be used. The source is opened later, by the acquisition thread.
  [[nodiscard]] Failure start();

  /// Port that the panel listens at; after start().
  [[nodiscard]] std::uint16_t panel_port() const;

  /// Waits up to `timeout`. True when the session has ended and the fit has settled.
  [[nodiscard]] bool wait_for_end(std::chrono::milliseconds timeout);

  /// Ends the session as if its last point had come. Any thread.
  void request_stop();

  /// What the panel shows now: the session's own screen needs no connection. After start().
  [[nodiscard]] PanelState panel_state() const;

  /// Points and verdicts for those who draw them; null where the settings ask for none. After start().
  [[nodiscard]] const PointFeed* feed() const;

  /// Start, stop, reset and acknowledge, as the coils of the panel. Any thread, after start().
  void press(const PanelCommands& commands);

  /// Gives what the session came to, and its points one by one: the memory for it does not depend on their number. Call
  /// once, after wait_for_end() was true. The panel goes on showing it, as ended, until the host is destroyed.
  [[nodiscard]] SessionResult finish(JudgedPoints& points);

  /// Shows on the panel what the whole result came to, and that the session has ended; what was found beside the fit is
  /// known there alone. After finish().
  void conclude(const Conclusion& conclusion);

 private:
  struct Running;

  /// Closes the panel once the clients that ask have seen its last state, after a second at the latest.
  void close_panel();

  HostSettings settings_;
  const DesignImage& design_;
  ProbeSource& source_;
  HostShared shared_;
  std::unique_ptr<Running> running_;
};

/// Path of the journal in a session folder.
[[nodiscard]] std::string journal_path(const std::string& session_directory);

}  // namespace bladefit
