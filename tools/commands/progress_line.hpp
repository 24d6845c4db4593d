#pragma once
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>

namespace bladefit {

/// One line on standard error that tells what is being done, where that is a terminal and the work has lasted a second.
class ProgressLine {
 public:
  ProgressLine() = default;
  ~ProgressLine() {
    if (shown_) std::fputs("\r\033[K", stderr);
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void tell(const std::string& step) {
    const auto elapsed = std::chrono::steady_clock::now() - began_;
    if (!terminal_ || elapsed < std::chrono::seconds(1)) return;
    std::fprintf(stderr, "\r\033[K%s ...", step.c_str());
    std::fflush(stderr);
    shown_ = true;
  }

 private:
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  bool terminal_ = ::isatty(STDERR_FILENO) == 1;
  bool shown_ = false;
};

}  // namespace bladefit
