#pragma once
#include <chrono>
#include <cstddef>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "firmware_bridge/host/feed/fed_point.hpp"

namespace bladefit {

/// Where a reader of the feed stopped.
struct FeedPlace {
  std::uint32_t cleared = 0;  ///< how often the feed was cleared before
  std::uint32_t slot = 0;     ///< slots before it have been read
  std::uint64_t change = 0;   ///< changes before it have been read
  friend bool operator==(const FeedPlace&, const FeedPlace&) = default;
};

/// What a reader got.
struct FeedPiece {
  std::size_t count = 0;  ///< points
  bool afresh = false;    ///< what the reader has of earlier pieces is void
  bool more = false;      ///< there are more at once
  FeedPlace next;         ///< from which to read on
};

/// The newest verdict of each point and those before, for readers that each come when they like. The memory is taken
/// by the constructor, but for the list of sequences, which is bounded too. Where there are more points than places the
/// one that has its place for longest makes room. One thread writes, any thread reads; a lock is held for the copying
/// of some points at the most, so that readers do not delay the writer.
class PointFeed {
 public:
  static constexpr std::size_t kPoints = 1U << 17U;
  static constexpr std::size_t kVerdicts = 1U << 18U;
  static constexpr std::size_t kLongestPiece = 1024;

  explicit PointFeed(std::size_t points = kPoints, std::size_t verdicts = kVerdicts);

  /// Takes a first verdict or a later one. What differs in nothing that is shown is no change.
  void judged(const Verdict& verdict);

  /// Takes a distance that has gone on with the pose, where it looks another one by now: of all such since the point
  /// was judged the newest is remembered. An unknown point is left out.
  void followed(const Verdict& verdict);

  /// Forgets every point.
  void clear();

  /// Copies the next points from a place on, each as it is now; first all, then those that have changed, kLongestPiece
  /// at most. A place that is too old to go on from begins afresh.
  [[nodiscard]] FeedPiece read(const FeedPlace& from, std::span<FedPoint> to) const;

  /// Where a reader stands who has read everything.
  [[nodiscard]] FeedPlace end() const;

  /// What a point was judged, the newest first, as far as it is remembered and `to` has room; how many were copied.
  [[nodiscard]] std::size_t history(std::uint32_t sequence, std::span<FedVerdict> to) const;

  /// When the times of its verdicts begin [ms since 1970].
  [[nodiscard]] std::int64_t begun_ms() const { return begun_ms_; }

 private:
  using Clock = std::chrono::steady_clock;
  /// A verdict, and the number of the one before it of the same point; numbers begin with 1.
  struct Remembered {
    FedVerdict verdict;
    std::uint64_t before = 0;
    bool followed = false;
  };
  struct Place {
    FedPoint point;
    std::uint64_t last = 0;  ///< number of its last verdict, which is that of its last change
  };

  [[nodiscard]] Place& place_of(std::uint32_t sequence);
  [[nodiscard]] FedVerdict fed(const Verdict& verdict) const;
  void put(Place& place, const Verdict& verdict, const Remembered& now);
  [[nodiscard]] bool is_remembered(std::uint64_t number) const {
    return number > 0 && number + remembered_.size() > last_;
  }
  [[nodiscard]] const Remembered& remembered(std::uint64_t number) const {
    return remembered_[number % remembered_.size()];
  }

  mutable std::mutex mutex_;
  std::size_t capacity_;
  std::vector<Place> places_;  ///< as many as there are points
  std::size_t oldest_ = 0;     ///< the slot that makes room next
  std::unordered_map<std::uint32_t, std::uint32_t> slots_;
  std::vector<Remembered> remembered_;
  std::uint64_t last_ = 0;  ///< number of the newest verdict
  std::uint32_t cleared_ = 0;
  Clock::time_point start_ = Clock::now();
  std::int64_t begun_ms_;
};

}  // namespace bladefit
