#pragma once
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

namespace bladefit {

/// A step of the work as the line tells it: with a bar and the time that is left where its parts are counted
/// (`of` > 0), else with the time that it has taken.
[[nodiscard]] std::string progress_text(const std::string& step, std::size_t done, std::size_t of,
                                        std::chrono::duration<double> taken);

/// One line on standard error that tells what is being done, where that is a terminal that can take a line back and the
/// work has lasted a second. It keeps time by itself in a thread of its own, and is gone when this object is.
class ProgressLine {
 public:
  /// `wanted`: false where nothing is to be told.
  explicit ProgressLine(bool wanted = true);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// The step that begins now.
  void begin(std::string step);

  /// So many parts `of` the step are done. Cost: a lock.
  void count(std::size_t done, std::size_t of);

 private:
  using Clock = std::chrono::steady_clock;
  void keep_time();

  std::mutex mutex_;
  std::condition_variable over_;
  std::string step_;
  std::size_t done_ = 0, of_ = 0;
  Clock::time_point step_began_ = Clock::now();
  bool ends_ = false;
  std::thread keeper_;
};

}  // namespace bladefit
