#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace bladefit {

/// The newest value of something, from one writing thread to one reading thread; values in between may be skipped.
/// No call locks, waits or allocates: of three slots the writer fills one, the reader holds one, and the third changes
/// hands.
template <typename Value>
class LatestValue {
  static_assert(std::is_trivially_destructible_v<Value>, "values are copied, and must own nothing");

 public:
  /// Writer only.
  void publish(const Value& value) {
    slots_[writing_] = value;
    writing_ = middle_.exchange(writing_ | kNewer, std::memory_order_acq_rel) & kIndex;
  }

  /// Reader only. True when there is a value newer than the last one taken; only then `value` is written.
  [[nodiscard]] bool take(Value& value) {
    if ((middle_.load(std::memory_order_relaxed) & kNewer) == 0) return false;
    reading_ = middle_.exchange(reading_, std::memory_order_acq_rel) & kIndex;
    value = slots_[reading_];
    return true;
  }

 private:
  static constexpr std::uint32_t kIndex = 3;
  static constexpr std::uint32_t kNewer = 4;
  std::array<Value, 3> slots_{};
  std::uint32_t writing_ = 0;
  std::uint32_t reading_ = 1;
  std::atomic<std::uint32_t> middle_{2};
};

}  // namespace bladefit
