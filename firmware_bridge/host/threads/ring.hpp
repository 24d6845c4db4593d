#pragma once
#include <atomic>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace bladefit {

/// Queue of fixed capacity from one writing thread to one reading thread. No call locks, waits or allocates; the
/// memory is taken by the constructor. What the writer did before push() is seen by the reader after pop().
template <typename Item>
class Ring {
  static_assert(std::is_trivially_destructible_v<Item>, "items are copied, and must own nothing");

 public:
  explicit Ring(std::size_t capacity) : slots_(capacity + 1) {}

  /// Writer only. False when the ring is full; then nothing has changed.
  [[nodiscard]] bool push(const Item& item) {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    const std::size_t next = after(tail);
    if (next == head_.load(std::memory_order_acquire)) return false;
    slots_[tail] = item;
    tail_.store(next, std::memory_order_release);
    return true;
  }

  /// Reader only. False when the ring is empty.
  [[nodiscard]] bool pop(Item& item) {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return false;
    item = slots_[head];
    head_.store(after(head), std::memory_order_release);
    return true;
  }

  /// Writer only: how many items can be pushed for certain.
  [[nodiscard]] std::size_t room() const {
    const std::size_t head = head_.load(std::memory_order_acquire);
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    return (head + slots_.size() - tail - 1) % slots_.size();
  }

  /// Either thread; the answer may be old by the time it is used.
  [[nodiscard]] bool empty() const {
    return head_.load(std::memory_order_acquire) == tail_.load(std::memory_order_acquire);
  }

 private:
  [[nodiscard]] std::size_t after(std::size_t index) const { return index + 1 == slots_.size() ? 0 : index + 1; }

  static constexpr std::size_t kCacheLine = 64;
  std::vector<Item> slots_;  // one slot stays free, to tell full from empty
  alignas(kCacheLine) std::atomic<std::size_t> head_{0};
  alignas(kCacheLine) std::atomic<std::size_t> tail_{0};
};

}  // namespace bladefit
