#include "tools/commands/run_stop_flag.hpp"

#include <atomic>
#include <tuple>

namespace bladefit {
namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not lock");

extern "C" void note_stop(int) { stop_requested.store(true); }

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ};

bool is_error_of_output(int signal) { return signal == SIGPIPE || signal == SIGXFSZ; }

}  // namespace

StopFlag::StopFlag() {
  static_assert(std::tuple_size_v<decltype(before_)> == kSignals.size());
  stop_requested.store(false);
  for (std::size_t k = 0; k < kSignals.size(); ++k) {
    struct sigaction action = {};
    action.sa_handler = is_error_of_output(kSignals[k]) ? SIG_IGN : note_stop;
    sigemptyset(&action.sa_mask);
    sigaction(kSignals[k], &action, &before_[k]);
    // Under nohup a terminal that closes is no reason to end.
    const bool kept = kSignals[k] == SIGHUP && before_[k].sa_handler == SIG_IGN;
    if (kept) sigaction(kSignals[k], &before_[k], nullptr);
  }
}

StopFlag::~StopFlag() {
  for (std::size_t k = 0; k < kSignals.size(); ++k) sigaction(kSignals[k], &before_[k], nullptr);
}

bool StopFlag::requested() const { return stop_requested.load(); }

}  // namespace bladefit
