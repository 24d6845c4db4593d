#include "drivers/serial/lasting_port.hpp"

#include <algorithm>
#include <thread>

#include "drivers/source/source_fault.hpp"

namespace bladefit {

void LastingPort::lost(const std::string& fault, SourceStatus& status) {
  port_.close();
  status.link = LinkState::lost;
  note_fault(status, fault);
  back_off_.failed(Clock::now());
}

bool LastingPort::reopen(Clock::time_point until, SourceStatus& status) {
  if (Clock::now() < back_off_.retry_at()) {
    std::this_thread::sleep_until(std::min(until, back_off_.retry_at()));
    return false;
  }
  if (const Failure failure = port_.open(line_)) {
    lost(failure.message, status);
    return false;
  }
  ++status.reconnects;
  back_off_.succeeded();
  return true;
}

}  // namespace bladefit
