#include "firmware_bridge/host/fit/fit_worker.hpp"

#include <algorithm>

namespace bladefit {
namespace {

constexpr std::chrono::milliseconds kWait{100};
constexpr std::chrono::milliseconds kRoomWait{1};
// In a burst the figures of the whole fit, which cost more than a push, may lag by so many events.
constexpr std::uint32_t kEventsBetweenFigures = 64;

}  // namespace

void FitWorker::run() {
  publish_figures();
  FitInput input;
  while (true) {
    if (!shared_.to_fit.ring.pop(input)) {
      if (events_since_figures_ > 0) publish_figures();
      report_distances();
      shared_.to_fit.wakeup.wait(sweep_.is_due(revision_) ? DistanceSweep::kPace : kWait);
      continue;
    }
    if (input.end) break;
    take(input.event);
    if (++events_since_figures_ >= kEventsBetweenFigures) {
      publish_figures();
      report_distances();
    }
  }
  if (input.finished) losses_.finish();
  stream_.settle();
  settled();
  publish_figures();
  shared_.fit_done.store(true);
  shared_.to_publication.wakeup.signal();
}

void FitWorker::take(const StreamEvent& event) {
  taken_at_ = Clock::now();
  static_cast<void>(losses_.take(event));
  stream_.follow(event, *this);
  publish_revisions();
}

void FitWorker::judged(const Verdict& verdict) {
  latency_.add(std::chrono::nanoseconds(Clock::now() - taken_at_).count());
  const bool stored = keep_place(verdict.sequence);
  publish({stored ? FitOutput::Kind::judged : FitOutput::Kind::judged_last, verdict});
  shared_.to_publication.wakeup.signal();
}

/// Follows the places in the fit: the new point may have taken one, also that of another point. False: it has none.
bool FitWorker::keep_place(std::uint32_t sequence) {
  Verdict verdict;
  if (stream_.localizer().verdict_of(sequence, verdict) != Status::ok) return false;
  verdict.sequence = stream_.localizer().displaced();
  const auto place = std::ranges::lower_bound(stored_sequences_, verdict.sequence);
  if (verdict.sequence != 0 && place != stored_sequences_.end() && *place == verdict.sequence) {
    stored_sequences_.erase(place);
    publish({FitOutput::Kind::given_up, verdict});
  }
  stored_sequences_.push_back(sequence);
  return true;
}

// A revision comes out when the state or the action changes. Now that the pose has come to rest the distances are
// reported again as well.
void FitWorker::settled() {
  publish_revisions();
  report_again(stored_sequences_, FitOutput::Kind::judged);
  shared_.to_publication.wakeup.signal();
}

void FitWorker::forgotten() {
  stored_sequences_.clear();
  alarms_.clear();
  publish({FitOutput::Kind::forgotten, {}});
}

void FitWorker::publish(const FitOutput& output) {
  if (output.kind == FitOutput::Kind::judged) alarms_.note(output.verdict);
  while (!shared_.to_publication.ring.push(output)) {
    shared_.to_publication.wakeup.signal();
    shared_.to_fit.wakeup.wait(kRoomWait);
  }
}

void FitWorker::publish_revisions() {
  FitOutput output;
  bool any = false;
  while (stream_.localizer().next_revision(output.verdict)) {
    publish(output);
    any = true;
  }
  if (any) shared_.to_publication.wakeup.signal();
}

void FitWorker::report_again(std::span<const std::uint32_t> sequences, FitOutput::Kind kind) {
  Verdict verdict;
  for (const std::uint32_t sequence : sequences) {
    if (sequence != 0 && stream_.localizer().verdict_of(sequence, verdict) == Status::ok) publish({kind, verdict});
  }
}

/// A few more points of the sweep. Nobody waits for them: they do without a signal, and where room is scarce.
void FitWorker::report_distances() {
  if (shared_.to_publication.ring.room() < decltype(shared_.to_publication)::kCapacity / 2) return;
  report_again(sweep_.next(stored_sequences_, revision_, Clock::now()), FitOutput::Kind::followed);
}

void FitWorker::publish_figures() {
  report_again(alarms_.sequences(), FitOutput::Kind::followed);
  constexpr double kPercentile = 0.99;
  const FitReport report = stream_.localizer().fit();
  revision_ = report.revision;
  shared_.fit_figures.publish({report, losses_, latency_.quantile_us(kPercentile)});
  events_since_figures_ = 0;
  shared_.to_publication.wakeup.signal();
}

}  // namespace bladefit
