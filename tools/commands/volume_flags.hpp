#pragma once
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
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

/// Tells how long the steps of a command took, where that is wanted.
class StepClock {
 public:
  StepClock(const Volume& volume, std::FILE* words) : words_(volume.verbose ? words : nullptr) {}

  /// The step that has just ended, in words such as "points read".
  void done(const std::string& step);

 private:
  std::FILE* words_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

}  // namespace bladefit
