#include "tools/simulate/machine.hpp"

#include <algorithm>
#include <utility>

namespace bladefit::simulate {

Machine::Machine(std::vector<MachinePoint> points, const MachineSettings& settings)
    : points_(std::move(points)), settings_(settings), period_(0) {
  if (settings_.rate > 0) {
    period_ = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / settings_.rate));
  }
}

void Machine::start(Clock::time_point now) {
  // A machine that was off meanwhile does not show again what the reader has.
  if (acknowledged_ > available_) available_ = acknowledged_;
  if (!probing_) next_due_ = now + period_;
  probing_ = true;
}

void Machine::restart(Clock::time_point now) {
  available_ = acknowledged_;
  overflowed_ = false;
  next_due_ = now + period_;
  probing_ = true;
}

bool Machine::acknowledge(std::uint32_t sequence) {
  if (sequence > total()) return false;
  acknowledged_ = sequence;
  return true;
}

bool Machine::ring_full() const {
  return available_ >= acknowledged_ && available_ - acknowledged_ >= settings_.capacity;
}

std::uint32_t Machine::oldest_kept() const {
  return available_ > settings_.capacity ? available_ - settings_.capacity + 1 : 1;
}

void Machine::advance(Clock::time_point now) {
  while (probing() && next_due_ <= now) {
    if (ring_full()) {
      if (!settings_.overflow) {
        // The feed stands still: what it missed is not made up for by a burst.
        next_due_ = std::max(next_due_, now);
        return;
      }
      overflowed_ = true;
    }
    ++available_;
    next_due_ += period_;
  }
}

std::optional<Clock::time_point> Machine::next_due() const {
  if (!probing() || (ring_full() && !settings_.overflow)) return std::nullopt;
  return next_due_;
}

}  // namespace bladefit::simulate
