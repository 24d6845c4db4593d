#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

#include "core/localizer.hpp"
#include "drivers/source/failure.hpp"
#include "drivers/source/probe_source.hpp"
#include "firmware_bridge/host/threads/latest_value.hpp"
#include "firmware_bridge/host/threads/ring.hpp"
#include "firmware_bridge/host/threads/stream_event.hpp"
#include "firmware_bridge/host/threads/wakeup.hpp"

namespace bladefit {

/// How a session ended, or that it goes on.
enum class SessionEnd : std::uint8_t { running, finished, idle, stopped, failed };

/// From the acquisition thread to the fit thread.
struct FitInput {
  bool end = false;  ///< no event follows
  StreamEvent event;
};

/// From the fit thread to the publication thread.
struct FitOutput {
  bool forget = false;  ///< all points so far are forgotten; `verdict` means nothing
  Verdict verdict;      ///< a first one or a revision
};

/// What the fit thread tells of the whole fit.
struct FitFigures {
  FitReport report;
  double push_p99_us = 0;
};

/// What the acquisition thread tells of the source.
struct LinkFigures {
  LinkState link = LinkState::connecting;
  std::uint64_t losses = 0;  ///< how often points were lost in the device
  bool paused = false;
  bool device_fault = false;
};

/// All that the threads of a host share. Everything in it may be used by two threads at once in the way that its own
/// header allows; there is no other state between threads.
struct HostShared {
  static constexpr std::size_t kRingCapacity = 4096;

  Ring<FitInput> to_fit{kRingCapacity};
  Ring<StreamEvent> to_journal{kRingCapacity};
  Ring<FitOutput> to_publication{kRingCapacity};
  LatestValue<FitFigures> fit_figures;
  LatestValue<LinkFigures> link_figures;
  Wakeup fit_wakeup, journal_wakeup, publication_wakeup, stored_wakeup;

  std::atomic<std::uint64_t> stored_events{0};    ///< how many events of `to_journal` are on disk
  std::atomic<std::uint32_t> stored_sequence{0};  ///< newest point on disk; 0 = none yet
  std::atomic<bool> journal_closed{false};        ///< nothing more comes through `to_journal`
  std::atomic<bool> fit_done{false};              ///< nothing more comes through `to_publication`
  std::atomic<bool> panel_closed{false};          ///< the panel is no longer wanted

  std::atomic<bool> stop_requested{false};
  std::atomic<bool> paused{false};
  std::atomic<bool> reset_requested{false};
  std::atomic<SessionEnd> end{SessionEnd::running};  ///< written by the acquisition thread
  std::atomic<bool> failed{false};

  /// Any thread but that of the fit. The first failure is kept; the session ends.
  void fail(const Failure& error) {
    const std::lock_guard lock(mutex_);
    if (!failed.load()) error_ = error;
    failed.store(true);
  }

  [[nodiscard]] Failure error() {
    const std::lock_guard lock(mutex_);
    return error_;
  }

  /// Any thread but that of the fit: a line for the log.
  void notice(const std::string& line) {
    const std::lock_guard lock(mutex_);
    if (on_notice) on_notice(line);
  }

  std::function<void(const std::string&)> on_notice;  ///< set before the threads start

 private:
  std::mutex mutex_;
  Failure error_;
};

}  // namespace bladefit
