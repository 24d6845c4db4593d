#include "tools/commands/volume_flags.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace bladefit {

void add_volume_flags(CLI::App& command, Volume& volume) {
  CLI::Option* const quiet =
      command.add_flag("--quiet", volume.quiet, "tell the line with the verdict alone, beside errors and warnings");
  command.add_flag("--verbose", volume.verbose, "tell also how long each step took")->excludes(quiet);
}

std::string told_of(const std::string& summary, const Volume& volume) {
  return volume.quiet ? summary.substr(0, summary.find('\n') + 1) : summary;
}

void StepClock::done(const std::string& step) {
  const auto now = std::chrono::steady_clock::now();
  if (told_) {
    const std::chrono::duration<double, std::milli> took = now - begun_;
    std::fputs(fmt::format("{}: {:.1f} ms\n", step, took.count()).c_str(), stderr);
  }
  begun_ = now;
}

}  // namespace bladefit
