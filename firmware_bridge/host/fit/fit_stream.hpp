#pragma once
#include <cstdint>

#include "core/localizer.hpp"
#include "firmware_bridge/host/threads/stream_event.hpp"

namespace bladefit {

/// Feeds a stream to a localizer. Which calls it makes, and in which order, follows from the stream alone, never from
/// the clock or from how the stream was cut into portions; so the same stream gives the same verdicts, bit for bit.
/// One thread owns it. No call allocates, locks or throws.
class FitStream {
 public:
  /// `path_refine_points`: how many stored points are projected again at most when a path has ended; none are when
  /// there are more points than that.
  FitStream(Localizer& localizer, std::uint32_t path_refine_points)
      : localizer_(localizer), path_refine_points_(path_refine_points) {}

  /// Pushes a point. True when `verdict` is the one of this point; a record that cannot be used gets the state
  /// `rejected`. False for a sequence number that is not above the last one: nothing has changed.
  [[nodiscard]] bool push(const ProbePoint& point, Verdict& verdict);

  /// To be called after every push, when the verdict is on its way: projects stored points again when that point was
  /// the first of another path. It is apart from push() so that the verdict does not wait for it.
  void end_path();

  /// Projects until the fit has converged, or a generous cap is reached. Does nothing when no point has come since.
  void settle();

  void reset();

  /// Feeds one event of a stream: the only place that says what an event does to the fit. The observer hears at once:
  /// judged(verdict) of a point, before the work at the end of a path, settled() after the end of the program,
  /// forgotten() after a reset.
  template <typename Observer>
  void follow(const StreamEvent& event, Observer&& observer) {
    switch (event.kind) {
      case EventKind::point: {
        Verdict verdict;
        if (!push(event.point, verdict)) return;
        observer.judged(verdict);
        return end_path();
      }
      case EventKind::finished:
        settle();
        return observer.settled();
      case EventKind::reset:
        reset();
        return observer.forgotten();
      case EventKind::lost_unnumbered:
      case EventKind::lost:
        return;
    }
  }

  /// The fit of exactly the events that `events(take)` gives to `take`, settled. Returns what `events` does.
  template <typename Events>
  auto replay(Events&& events) {
    reset();
    auto outcome = events([this](const StreamEvent& event) { follow(event, NoObserver()); });
    settle();
    return outcome;
  }

  [[nodiscard]] Localizer& localizer() { return localizer_; }

 private:
  /// Of a fit that nobody watches.
  struct NoObserver {
    void judged(const Verdict& /*verdict*/) const {}
    void settled() const {}
    void forgotten() const {}
  };

  Localizer& localizer_;
  std::uint32_t path_refine_points_;
  std::uint16_t path_ = 0;  // 0 = unknown
  bool path_ended_ = false;
  bool settled_ = true;
};

}  // namespace bladefit
