#pragma once
#include <functional>
#include <mutex>
#include <string>
#include <utility>

namespace bladefit {

/// Lines for the log, from any thread but that of the fit, one at a time.
class NoticeSink {
 public:
  explicit NoticeSink(std::function<void(const std::string&)> on_notice) : on_notice_(std::move(on_notice)) {}

  void write(const std::string& line) {
    const std::lock_guard lock(mutex_);
    if (on_notice_) on_notice_(line);
  }

 private:
  std::mutex mutex_;
  std::function<void(const std::string&)> on_notice_;
};

}  // namespace bladefit
