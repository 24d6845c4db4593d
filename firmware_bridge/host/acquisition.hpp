#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include "firmware_bridge/host/journal/disk_watch.hpp"
#include "firmware_bridge/host/journal/journal.hpp"
#include "firmware_bridge/host/journal/journal_reader.hpp"
#include "firmware_bridge/host/threads/host_shared.hpp"

namespace bladefit {

struct AcquisitionSettings {
  SessionIdentity identity;
  std::string directory;              ///< of the session
  std::string settings_text;          ///< written into it when the session begins
  bool end_when_finished = false;     ///< the session ends when the device says that its program is finished
  std::chrono::milliseconds idle{0};  ///< it ends when no new point came for so long; 0 = never
  std::uint32_t planned = 0;          ///< as that of HostSettings
};

/// Takes points from the source and gives them to the fit and to the journal; acknowledges what is on disk. Runs in
/// the acquisition thread, which may wait for the device.
class Acquisition {
 public:
  /// `recorded`: what the journal holds from before; it is given to the fit again, in the same order.
  Acquisition(AcquisitionSettings settings, const JournalReader& recorded, ProbeSource& source, Journal& journal,
              HostShared& shared)
      : settings_(std::move(settings)),
        recorded_(recorded),
        source_(source),
        journal_(journal),
        shared_(shared),
        disk_(settings_.directory) {}

  /// Runs until the session ends; then everything taken is on disk, unless the session has failed.
  void run();

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] bool replay_recorded();
  [[nodiscard]] Failure begin_session();
  [[nodiscard]] bool open_source();
  void take_points();
  void take_point(const ProbePoint& point);
  void follow_commands();
  void follow_source();
  void announce_changes(const SourceStatus& status);
  [[nodiscard]] bool run_id_has_changed();
  [[nodiscard]] bool link_is_gone();
  [[nodiscard]] SessionEnd end_reached();
  void take_losses(const SourceStatus& status);
  [[nodiscard]] bool source_has_stopped();
  [[nodiscard]] bool program_ended(SessionEnd end) const;
  void take(const StreamEvent& event);
  void give_to_fit(const FitInput& input);
  void acknowledge_stored();
  void watch_disk();
  void finish(SessionEnd end);

  AcquisitionSettings settings_;
  const JournalReader& recorded_;
  ProbeSource& source_;
  Journal& journal_;
  HostShared& shared_;
  DiskWatch disk_;
  std::uint32_t last_sequence_ = 0;
  std::uint32_t acknowledged_ = 0;
  std::uint32_t run_id_ = 0;
  std::uint64_t taken_events_ = 0;
  bool finish_taken_ = false;
  bool opened_ = false;
  /// What was last told of the source.
  struct Announced {
    LinkState link = LinkState::up;
    Clock::time_point since = Clock::now();  ///< that state
    bool fault = false;
    std::uint64_t losses = 0;
    std::size_t remarks = 0;
  } announced_;
  std::uint64_t unnumbered_losses_ = 0;         ///< that are in the stream
  Clock::time_point last_news_ = Clock::now();  ///< when a point came or was stored last
};

}  // namespace bladefit
