#include "firmware_bridge/host/threads/wakeup.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>
#include <stdexcept>

namespace bladefit {

Wakeup::Wakeup() : descriptor_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (descriptor_ < 0) throw std::runtime_error("no file descriptor left for a wake-up; raise the limit (ulimit -n)");
}

Wakeup::~Wakeup() { close(descriptor_); }

void Wakeup::signal() const {
  const std::uint64_t one = 1;
  // The write can only fail when 2^64 - 2 wake-ups are waiting already, and then nothing is lost.
  [[maybe_unused]] const auto written = write(descriptor_, &one, sizeof one);
}

void Wakeup::wait(std::chrono::milliseconds timeout) const {
  pollfd waiting{descriptor_, POLLIN, 0};
  if (poll(&waiting, 1, static_cast<int>(timeout.count())) > 0) clear();
}

void Wakeup::clear() const {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto taken = read(descriptor_, &count, sizeof count);
}

}  // namespace bladefit
