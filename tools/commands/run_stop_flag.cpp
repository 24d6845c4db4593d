#include "tools/commands/run_stop_flag.hpp"

#include <atomic>

namespace bladefit {
namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not lock");

extern "C" void note_stop(int) { stop_requested.store(true); }

}  // namespace

StopFlag::StopFlag() {
  stop_requested.store(false);
  struct sigaction action = {};
  action.sa_handler = note_stop;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &interrupt_before_);
  sigaction(SIGTERM, &action, &terminate_before_);
}

StopFlag::~StopFlag() {
  sigaction(SIGINT, &interrupt_before_, nullptr);
  sigaction(SIGTERM, &terminate_before_, nullptr);
}

bool StopFlag::requested() const { return stop_requested.load(); }

}  // namespace bladefit
