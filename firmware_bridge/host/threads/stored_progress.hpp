#pragma once
#include <atomic>
#include <cstdint>

#include "firmware_bridge/host/threads/wakeup.hpp"

namespace bladefit {

/// What of the session is on disk. Written by the journal thread, read by that of the acquisition.
struct StoredProgress {
  std::atomic<std::uint64_t> events{0};    ///< how many of those given to the journal
  std::atomic<std::uint32_t> sequence{0};  ///< of the newest point, or record given up; 0 = none yet
  Wakeup wakeup;                           ///< more came onto the disk
};

}  // namespace bladefit
