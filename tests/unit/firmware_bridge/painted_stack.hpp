#pragma once
#include <ucontext.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <span>
#include <vector>

namespace bladefit::testing {

/// Runs work on a stack of its own that is painted before, and looks afterwards how far it was overwritten.
class PaintedStack {
 public:
  PaintedStack() : words_(kSize / sizeof(std::uint64_t)) {}
  PaintedStack(const PaintedStack&) = delete;
  PaintedStack& operator=(const PaintedStack&) = delete;

  /// Bytes below the frame that calls `work` which were overwritten.
  [[nodiscard]] std::size_t used_by(const std::function<void()>& work) {
    std::ranges::fill(words_, kPaint);
    work_ = &work;
    running_ = this;
    if (::getcontext(&inside_) != 0) std::abort();
    inside_.uc_stack.ss_sp = words_.data();
    inside_.uc_stack.ss_size = kSize;
    inside_.uc_link = &outside_;
    ::makecontext(&inside_, &PaintedStack::enter, 0);
    if (::swapcontext(&outside_, &inside_) != 0) std::abort();
    const auto lowest = std::ranges::find_if(words_, [](std::uint64_t word) { return word != kPaint; });
    if (lowest == words_.begin()) std::abort();  // it did not suffice
    return top_ - reinterpret_cast<std::uintptr_t>(&*lowest);
  }

 private:
  static constexpr std::size_t kSize = 512 * 1024;
  static constexpr std::uint64_t kPaint = 0xA5C3A5C3A5C3A5C3ULL;

  [[gnu::noinline]] static void enter() {
    PaintedStack& stack = *running_;
    stack.top_ = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
    (*stack.work_)();
  }

  static inline PaintedStack* running_ = nullptr;
  std::vector<std::uint64_t> words_;
  const std::function<void()>* work_ = nullptr;
  ucontext_t inside_{}, outside_{};
  std::uintptr_t top_ = 0;
};

}  // namespace bladefit::testing
