#include "drivers/source/wait_ready.hpp"

#include <poll.h>

#include <algorithm>
#include <ctime>

namespace bladefit {

Readiness wait_ready(int descriptor, bool for_writing, std::chrono::steady_clock::time_point until) {
  const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(until - std::chrono::steady_clock::now());
  const auto nanoseconds = std::max<std::int64_t>(left.count(), 0);
  timespec timeout{};
  timeout.tv_sec = static_cast<std::time_t>(nanoseconds / 1'000'000'000);
  timeout.tv_nsec = static_cast<long>(nanoseconds % 1'000'000'000);
  const auto wanted = static_cast<short>(for_writing ? POLLOUT : POLLIN);
  pollfd entry{descriptor, wanted, 0};
  if (::ppoll(&entry, 1, &timeout, nullptr) <= 0) return Readiness::timeout;
  if ((entry.revents & wanted) != 0) return Readiness::ready;
  return Readiness::hang_up;
}

}  // namespace bladefit
