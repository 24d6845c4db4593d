#pragma once
#include <csignal>

namespace bladefit {

/// Notes Ctrl-C (SIGINT) and SIGTERM for as long as it lives, instead of dying of them. One at a time.
class StopFlag {
 public:
  StopFlag();
  ~StopFlag();
  StopFlag(const StopFlag&) = delete;
  StopFlag& operator=(const StopFlag&) = delete;

  [[nodiscard]] bool requested() const;

 private:
  struct sigaction interrupt_before_ = {};
  struct sigaction terminate_before_ = {};
};

}  // namespace bladefit
