#pragma once
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

namespace bladefit {

/// Whose distances are to be told again while the pose moves, in turn and at a slow pace: a revision comes out only
/// when the state or the action of a point changes, and those who draw points want their distances too. Bounded work: a
/// slice at the most every kPace, which is 65,536 points in some 10 s. No call allocates.
class DistanceSweep {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kSlice = 64;
  static constexpr std::chrono::milliseconds kPace{10};

  /// The next slice of `stored`, the points with a place in the fit; empty before its time, and where all have been
  /// told since the pose came to `revision`.
  [[nodiscard]] std::span<const std::uint32_t> next(std::span<const std::uint32_t> stored, std::uint32_t revision,
                                                    Clock::time_point now) {
    if (!is_due(revision) || now < again_) return {};
    again_ = now + kPace;
    if (at_ == 0) revision_ = revision;
    const std::size_t begin = std::min(at_, stored.size()), count = std::min(kSlice, stored.size() - begin);
    at_ = begin + count < stored.size() ? begin + count : 0;
    return stored.subspan(begin, count);
  }

  /// Whether there is a slice, now or a little later.
  [[nodiscard]] bool is_due(std::uint32_t revision) const { return at_ > 0 || revision != revision_; }

 private:
  std::size_t at_ = 0;
  std::uint32_t revision_ = 0;  ///< of the fit, when the sweep began
  Clock::time_point again_{};
};

}  // namespace bladefit
