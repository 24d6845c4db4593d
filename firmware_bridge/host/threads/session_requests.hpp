#pragma once
#include <atomic>

namespace bladefit {

/// What an operator has asked for and the acquisition thread has not yet done. Any thread.
struct SessionRequests {
  std::atomic<bool> stop{false};   ///< end as if the last point had come
  std::atomic<bool> pause{false};  ///< take no points; may be taken back
  std::atomic<bool> reset{false};  ///< forget all points so far
};

}  // namespace bladefit
