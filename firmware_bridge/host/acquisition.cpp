#include "firmware_bridge/host/acquisition.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <thread>

#include "firmware_bridge/host/journal/session_settings_file.hpp"

namespace bladefit {
namespace {

constexpr std::chrono::milliseconds kPollTimeout{10};
constexpr std::chrono::milliseconds kRoomPause{1};
constexpr std::chrono::milliseconds kStoreWait{100};
constexpr std::size_t kPollPoints = 64;

template <std::size_t size>
void copy_words(const std::string& text, std::array<char, size>& words) {
  words.fill(0);
  std::copy_n(text.begin(), std::min(text.size(), size - 1), words.begin());
}

}  // namespace

void Acquisition::run() {
  SessionEnd end = SessionEnd::stopped;
  if (replay_recorded() && !shared_.requests.stop.load() && open_source()) {
    end = SessionEnd::running;
    while (end == SessionEnd::running) {
      follow_commands();
      take_points();
      acknowledge_stored();
      watch_disk();
      follow_source();
      end = end_reached();
    }
  }
  finish(end);
}

bool Acquisition::replay_recorded() {
  const Failure error = recorded_.for_each([this](const StreamEvent& event) {
    if (event.kind == EventKind::point || event.kind == EventKind::lost) last_sequence_ = event.point.sequence;
    finish_taken_ = event.kind == EventKind::finished;
    give_to_fit({.event = event});
  });
  if (error) shared_.outcome.fail(error);
  shared_.stored.sequence.store(last_sequence_);
  return !error;
}

bool Acquisition::open_source() {
  const JournalSummary& recorded = recorded_.summary();
  if (const Failure failure = source_.open(last_sequence_, recorded.run_id)) {
    shared_.outcome.fail(failure);
    return false;
  }
  opened_ = true;
  run_id_ = source_.status().run_id;
  if (!recorded.exists) {
    const Failure error = begin_session();
    if (error) shared_.outcome.fail(error);
    return !error;
  }
  if (recorded.run_id != run_id_) {
    shared_.outcome.fail(bad_input(
        fmt::format("the device is in run {}, the session folder holds run {}: its points have other numbers; "
                    "name another session folder with --session",
                    run_id_, recorded.run_id)));
    return false;
  }
  last_news_ = Clock::now();
  return true;
}

Failure Acquisition::begin_session() {
  if (Failure error = journal_.start(settings_.identity, run_id_)) return error;
  return write_settings(settings_.directory, settings_.settings_text);
}

void Acquisition::take_points() {
  if (shared_.requests.pause.load()) {
    std::this_thread::sleep_for(kPollTimeout);
    return;
  }
  std::array<ProbePoint, kPollPoints> points;
  const std::size_t count = source_.poll(points, kPollTimeout);
  for (const ProbePoint& point : std::span(points).first(count)) take_point(point);
}

void Acquisition::take_point(const ProbePoint& point) {
  // Sources promise rising numbers; a record that breaks the promise must not reach the journal.
  if (point.sequence <= last_sequence_) return;
  last_sequence_ = point.sequence;
  last_news_ = Clock::now();
  finish_taken_ = false;
  take({EventKind::point, point});
}

// The fit comes first: its alarm is what the operator waits for.
void Acquisition::take(const StreamEvent& event) {
  give_to_fit({.event = event});
  while (!shared_.to_journal.ring.push(event) && !shared_.outcome.failed()) {
    watch_disk();
    std::this_thread::sleep_for(kRoomPause);
  }
  shared_.to_journal.wakeup.signal();
  ++taken_events_;
}

void Acquisition::give_to_fit(const FitInput& input) {
  while (!shared_.to_fit.ring.push(input)) std::this_thread::sleep_for(kRoomPause);
  shared_.to_fit.wakeup.signal();
}

void Acquisition::follow_commands() {
  if (!shared_.requests.reset.exchange(false)) return;
  finish_taken_ = false;
  take({EventKind::reset, {}});
  shared_.notices.write("all points so far are forgotten, as the panel asked");
}

void Acquisition::follow_source() {
  const SourceStatus& status = source_.status();
  announce_changes(status);
  take_losses(status);
  LinkFigures figures{.link = status.link,
                      .losses = status.losses,
                      .paused = shared_.requests.pause.load(),
                      .device_fault = status.device_fault,
                      .planned = status.planned != 0 ? status.planned : settings_.planned,
                      .since = announced_.since};
  copy_words(status.last_fault, figures.fault);
  copy_words(status.last_loss, figures.loss);
  shared_.link_figures.publish(figures);
  if (!status.finished || finish_taken_) return;
  finish_taken_ = true;
  StreamEvent finish{EventKind::finished, {}};
  finish.point.sequence = status.last;
  take(finish);
}

/// What is given up is journalled, and so acknowledged: a device whose memory is full of such records waits for that.
void Acquisition::take_losses(const SourceStatus& status) {
  if (status.last > last_sequence_) {
    last_sequence_ = status.last;
    last_news_ = Clock::now();
    StreamEvent lost{EventKind::lost, {}};
    lost.point.sequence = status.last;
    take(lost);
  }
  if (status.unnumbered_losses == unnumbered_losses_) return;
  unnumbered_losses_ = status.unnumbered_losses;
  take({EventKind::lost_unnumbered, {}});
}

/// Whether the device's program is finished. One that cannot tell is finished when the session is ended.
bool Acquisition::program_ended(SessionEnd end) const {
  if (finish_taken_) return true;
  return !source_.tells_end() && (end == SessionEnd::idle || end == SessionEnd::stopped);
}

void Acquisition::announce_changes(const SourceStatus& status) {
  const bool announce =
      status.link != announced_.link || status.losses != announced_.losses || status.device_fault != announced_.fault;
  if (status.link != announced_.link && status.link == LinkState::lost) {
    shared_.notices.write(fmt::format("link lost: {}", status.last_fault));
  }
  if (status.link != announced_.link && status.link == LinkState::up) shared_.notices.write("link is up again");
  if (status.losses != announced_.losses) shared_.notices.write(status.last_loss);
  for (; announced_.remarks < status.remarks.size(); ++announced_.remarks)
    shared_.notices.write(status.remarks[announced_.remarks]);
  if (status.device_fault != announced_.fault) {
    shared_.notices.write(status.device_fault ? "the device reports a fault; see its own screen"
                                              : "the device's fault is over");
  }
  announced_.fault = status.device_fault;
  if (status.link != announced_.link) announced_.since = Clock::now();
  announced_.link = status.link;
  announced_.losses = status.losses;
  if (announce) shared_.to_publication.wakeup.signal();
}

bool Acquisition::run_id_has_changed() {
  const std::uint32_t now = source_.status().run_id;
  if (now == run_id_) return false;
  shared_.outcome.fail(
      device_failure(fmt::format("the device has left run {} and started run {}, which numbers its points "
                                 "from 1 again; start a session in another folder for it",
                                 run_id_, now)));
  return true;
}

bool Acquisition::source_has_stopped() {
  const std::string& why = source_.status().stopped;
  if (!why.empty()) shared_.outcome.fail(device_failure(why));
  return !why.empty();
}

/// No point came for the whole idle time, and none could have come: that is no end of a program.
bool Acquisition::link_is_gone() {
  if (source_.status().link != LinkState::lost) return false;
  shared_.outcome.fail(
      device_failure(fmt::format("the link is lost and did not come back: {}; repair it, then run the session "
                                 "again with the same --session to go on",
                                 source_.status().last_fault)));
  return true;
}

SessionEnd Acquisition::end_reached() {
  if (run_id_has_changed() || source_has_stopped() || shared_.outcome.failed()) return SessionEnd::failed;
  if (shared_.requests.stop.load()) return SessionEnd::stopped;
  if (settings_.end_when_finished && finish_taken_) return SessionEnd::finished;
  // While records are behind the source asks for them, and in the end gives them up.
  // A device whose memory is full waits for a slow disk, and not for its program.
  const bool stored = shared_.stored.events.load() >= taken_events_;
  const bool idle = settings_.idle.count() > 0 && stored && Clock::now() - last_news_ > settings_.idle;
  if (!idle || shared_.requests.pause.load() || (source_.status().behind && source_.status().link == LinkState::up))
    return SessionEnd::running;
  return link_is_gone() ? SessionEnd::failed : SessionEnd::idle;
}

void Acquisition::acknowledge_stored() {
  const std::uint32_t stored = shared_.stored.sequence.load();
  if (stored == acknowledged_) return;
  acknowledged_ = stored;
  last_news_ = Clock::now();
  source_.acknowledge(stored);
}

void Acquisition::watch_disk() {
  const std::string told = disk_.look(taken_events_, shared_.stored.events.load(), DiskWatch::Clock::now());
  if (!told.empty()) shared_.notices.write(told);
}

void Acquisition::finish(SessionEnd end) {
  while (shared_.stored.events.load() < taken_events_ && !shared_.outcome.failed()) {
    shared_.stored.wakeup.wait(kStoreWait);
    watch_disk();
  }
  if (opened_) {
    acknowledge_stored();
    source_.close();
  }
  shared_.journal_closed.store(true);
  shared_.to_journal.wakeup.signal();
  give_to_fit({.end = true, .finished = program_ended(end), .event = {}});
  shared_.outcome.set_program_ended(program_ended(end));
  shared_.outcome.conclude(end);
}

}  // namespace bladefit
