#pragma once
#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/scratch_folder.hpp"

namespace bladefit::hil {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using testing::read_whole;
using testing::ScratchFolder;

inline constexpr auto kPatience = 60s;  ///< after this a test fails instead of hanging

/// Asks `condition` every two milliseconds until it holds or `patience` is over. Returns whether it held.
template <typename Condition>
bool eventually(Condition condition, std::chrono::milliseconds patience = kPatience) {
  const Clock::time_point until = Clock::now() + patience;
  while (!condition()) {
    if (Clock::now() >= until) return false;
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

/// A real process whose two outputs go to files. It is killed when this object ends, or the test dies.
class Process {
 public:
  explicit Process(std::vector<std::string> arguments);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  [[nodiscard]] std::string out() const { return read_whole(scratch_ / "out"); }
  [[nodiscard]] std::string err() const { return read_whole(scratch_ / "err"); }
  void signal(int number) const;

  /// Kills it as a power cut would, and waits until it is gone.
  void power_off();

  /// Waits for the end. The exit code, or 128 + the signal that ended it; nothing when patience is over.
  [[nodiscard]] std::optional<int> exit_code(std::chrono::milliseconds patience = kPatience);

  /// True while it has not ended.
  [[nodiscard]] bool running() const;

  /// Waits until standard output holds `text`. Returns the rest of the line behind it; nothing when patience is over or
  /// the process has ended without it.
  [[nodiscard]] std::optional<std::string> wait_for(const std::string& text,
                                                    std::chrono::milliseconds patience = kPatience) const;

 private:
  [[noreturn]] void become_child() const;

  ScratchFolder scratch_;
  std::vector<std::string> arguments_;
  pid_t pid_ = -1;
};

std::vector<std::string> operator+(std::vector<std::string> left, const std::vector<std::string>& right);

/// The path of a file of tests/data.
std::string data_file(const std::string& name);

}  // namespace bladefit::hil
