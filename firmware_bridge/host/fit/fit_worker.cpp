#include "firmware_bridge/host/fit/fit_worker.hpp"

#include <algorithm>
#include <chrono>

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
    if (!shared_.to_fit.pop(input)) {
      if (events_since_figures_ > 0) publish_figures();
      shared_.fit_wakeup.wait(kWait);
      continue;
    }
    if (input.end) break;
    judge(input.event);
    if (++events_since_figures_ >= kEventsBetweenFigures) publish_figures();
  }
  settle();
  publish_figures();
  shared_.fit_done.store(true);
  shared_.publication_wakeup.signal();
}

void FitWorker::judge(const StreamEvent& event) {
  switch (event.kind) {
    case EventKind::point:
      judge_point(event.point);
      break;
    case EventKind::finished:
      settle();
      break;
    case EventKind::reset:
      stream_.reset();
      stored_sequences_.clear();
      listed_.fill(0);
      publish({true, {}});
      break;
  }
  publish_revisions();
}

void FitWorker::judge_point(const ProbePoint& point) {
  Verdict verdict;
  const auto before = std::chrono::steady_clock::now();
  const bool judged = stream_.push(point, verdict);
  latency_.add(std::chrono::nanoseconds(std::chrono::steady_clock::now() - before).count());
  if (!judged) return;
  const bool stored = verdict.state != PointState::rejected && stored_sequences_.size() < stored_sequences_.capacity();
  if (stored) stored_sequences_.push_back(verdict.sequence);
  publish({false, verdict});
  shared_.publication_wakeup.signal();
  stream_.end_path();
}

void FitWorker::publish(const FitOutput& output) {
  const Verdict& verdict = output.verdict;
  const bool listed = verdict.state == PointState::out && verdict.region == Region::leading_edge;
  if (listed && std::ranges::find(listed_, verdict.sequence) == listed_.end()) {
    listed_[listed_next_] = verdict.sequence;
    listed_next_ = (listed_next_ + 1) % listed_.size();
  }
  while (!shared_.to_publication.push(output)) {
    shared_.publication_wakeup.signal();
    shared_.fit_wakeup.wait(kRoomWait);
  }
}

void FitWorker::publish_revisions() {
  FitOutput output;
  bool any = false;
  while (stream_.localizer().next_revision(output.verdict)) {
    publish(output);
    any = true;
  }
  if (any) shared_.publication_wakeup.signal();
}

// A revision comes out when the state or the action changes. Now that the pose has come to rest the distances are told
// anew as well.
void FitWorker::settle() {
  stream_.settle();
  publish_revisions();
  Verdict verdict;
  for (const std::uint32_t sequence : stored_sequences_) {
    if (stream_.localizer().verdict_of(sequence, verdict) == Status::ok) publish({false, verdict});
  }
  shared_.publication_wakeup.signal();
}

// The distances in the panel's list follow the fit also while the verdicts stay the same.
void FitWorker::publish_listed() {
  Verdict verdict;
  for (const std::uint32_t sequence : listed_) {
    if (sequence != 0 && stream_.localizer().verdict_of(sequence, verdict) == Status::ok) publish({false, verdict});
  }
}

void FitWorker::publish_figures() {
  publish_listed();
  constexpr double kPercentile = 0.99;
  shared_.fit_figures.publish({stream_.localizer().fit(), latency_.quantile_us(kPercentile)});
  events_since_figures_ = 0;
  shared_.publication_wakeup.signal();
}

}  // namespace bladefit
