#pragma once
#include <array>
#include <csignal>

namespace bladefit {

/// Notes Ctrl-C (SIGINT), SIGTERM and a terminal that was closed (SIGHUP) for as long as it lives, instead of dying of
/// them; an output that nobody reads any more (SIGPIPE) or that has its largest size (SIGXFSZ) is an error of that
/// output alone. One at a time.
class StopFlag {
 public:
  StopFlag();
  ~StopFlag();
  StopFlag(const StopFlag&) = delete;
  StopFlag& operator=(const StopFlag&) = delete;

  [[nodiscard]] bool requested() const;

 private:
  std::array<struct sigaction, 5> before_{};
};

}  // namespace bladefit
