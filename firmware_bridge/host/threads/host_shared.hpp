#pragma once
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "core/localizer.hpp"
#include "drivers/source/probe_source.hpp"
#include "firmware_bridge/host/threads/channel.hpp"
#include "firmware_bridge/host/threads/latest_value.hpp"
#include "firmware_bridge/host/threads/notice_sink.hpp"
#include "firmware_bridge/host/threads/session_outcome.hpp"
#include "firmware_bridge/host/threads/session_requests.hpp"
#include "firmware_bridge/host/threads/stored_progress.hpp"
#include "firmware_bridge/host/threads/stream_event.hpp"
#include "firmware_bridge/host/threads/stream_losses.hpp"

namespace bladefit {

/// From the acquisition thread to the fit thread.
struct FitInput {
  bool end = false;       ///< no event follows
  bool finished = false;  ///< and that is the end of the device's program
  StreamEvent event;
};

/// From the fit thread to the publication thread.
struct FitOutput {
  enum class Kind : std::uint8_t {
    judged,       ///< `verdict` is a first one or a revision
    judged_last,  ///< the same, and no revision of it will come: the point has no place in the fit
    followed,     ///< `verdict` is in state and action what was told before; its distance has gone on with the pose
    given_up,     ///< no revision will come of the point with the sequence of `verdict`, whose rest means nothing
    forgotten,    ///< all points so far are forgotten; `verdict` means nothing
  };
  Kind kind = Kind::judged;
  Verdict verdict;
};

/// What the fit thread reports of the whole fit.
struct FitFigures {
  FitReport report;
  StreamLosses losses;
  double push_p99_us = 0;
};

/// What the acquisition thread reports of the source.
struct LinkFigures {
  LinkState link = LinkState::connecting;
  std::uint64_t losses = 0;  ///< how often points were lost in the device
  bool paused = false;
  bool device_fault = false;
  std::uint32_t planned = 0;                      ///< points that the source will give; 0 = not known
  std::chrono::steady_clock::time_point since{};  ///< when the link came to this state
  /// The newest fault of the link, and the newest loss of points, in words as far as they fit, ended by 0.
  static constexpr std::size_t kWords = 161;
  std::array<char, kWords> fault{}, loss{};
};

/// All that the threads of a host share. Everything in it may be used by two threads at once in the way that its own
/// header allows; there is no other state between threads.
struct HostShared {
  explicit HostShared(std::function<void(const std::string&)> on_notice) : notices(std::move(on_notice)) {}

  Channel<FitInput> to_fit;
  Channel<StreamEvent> to_journal;
  Channel<FitOutput> to_publication;  ///< its wake-up also stands for new figures and for `panel_closed`
  LatestValue<FitFigures> fit_figures;
  LatestValue<LinkFigures> link_figures;
  StoredProgress stored;
  SessionRequests requests;
  SessionOutcome outcome;
  NoticeSink notices;

  std::atomic<bool> journal_closed{false};  ///< nothing more comes through `to_journal`
  std::atomic<bool> fit_done{false};        ///< nothing more comes through `to_publication`
  std::atomic<bool> panel_closed{false};    ///< the panel is no longer wanted
};

}  // namespace bladefit
