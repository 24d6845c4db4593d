#pragma once
#include <CLI/CLI.hpp>
#include <chrono>
#include <string>

namespace bladefit {

/// How much a command tells. Errors, warnings and the exit code are the same in any case.
struct Volume {
  bool quiet = false;    ///< of all words the line with the verdict alone
  bool verbose = false;  ///< also how long each step took
};

void add_volume_flags(CLI::App& command, Volume& volume);

/// What of a summary is told: all of it, or its first line.
[[nodiscard]] std::string told_of(const std::string& summary, const Volume& volume);

/// Tells on standard error how long the steps of a command took, where that is wanted.
class StepClock {
 public:
  explicit StepClock(const Volume& volume) : told_(volume.verbose) {}

  /// The step that has just ended, in words such as "points read".
  void done(const std::string& step);

 private:
  bool told_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

}  // namespace bladefit
