#pragma once
#include <cstddef>

#include "firmware_bridge/host/threads/ring.hpp"
#include "firmware_bridge/host/threads/wakeup.hpp"

namespace bladefit {

/// A ring with what wakes its reader. The reader sleeps on `wakeup`, which others may signal for news of their own; who
/// pushes decides when a signal is worth its system call.
template <typename Item>
struct Channel {
  static constexpr std::size_t kCapacity = 4096;

  Ring<Item> ring{kCapacity};
  Wakeup wakeup;
};

}  // namespace bladefit
