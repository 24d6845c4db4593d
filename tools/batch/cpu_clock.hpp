#pragma once
#include <ctime>

namespace bladefit {

/// CPU time that this thread has used so far [s].
[[nodiscard]] inline double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace bladefit
