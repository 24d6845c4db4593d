#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "tools/web/web_source.hpp"

namespace bladefit {

/// Text that several clients are sent.
using SharedText = std::shared_ptr<const std::string>;

/// Events (of a server-sent stream) for clients that watch. Those that stand at the same place get the same text, made
/// once: what the host is asked does not grow with their number. Any thread.
class LiveFrames {
 public:
  static constexpr std::chrono::milliseconds kTick{30};    ///< clients look for news so often, all at once
  static constexpr std::chrono::milliseconds kState{100};  ///< the state is made so often at the most

  LiveFrames(const WebSource& source, bool commands);

  /// The first event: it names this run of the host, since what a page has of another one is void, and when its times
  /// begin.
  [[nodiscard]] std::string hello() const;

  struct Points {
    SharedText text;  ///< null where there is nothing new
    FeedPlace next;
    bool more = false;
  };
  /// The points from a place on, as an event whose id names the place after them.
  [[nodiscard]] Points points(const FeedPlace& from);

  struct State {
    SharedText text;
    std::uint64_t number = 0;  ///< another one where the text is another one
  };
  /// The newest state, as an event.
  [[nodiscard]] State state();

  /// Reads the id of an event back; the beginning where it is not of this run.
  [[nodiscard]] FeedPlace place_of(const std::string& id) const;

  /// When all look for news again.
  [[nodiscard]] static std::chrono::steady_clock::time_point next_tick();

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kKept = 8;
  struct Kept {
    FeedPlace from;
    Points points;
  };

  [[nodiscard]] Points make_points(const FeedPlace& from);

  const WebSource& source_;
  bool commands_;
  std::string run_;
  std::mutex points_mutex_;
  std::array<Kept, kKept> kept_;  ///< the newest, in turn
  std::size_t turn_ = 0;
  std::array<FedPoint, PointFeed::kLongestPiece> room_{};
  std::mutex state_mutex_;
  State state_;
  Clock::time_point made_{};
};

}  // namespace bladefit
