#pragma once
#include <unistd.h>

#include <cstdio>

#include "firmware_bridge/host/host.hpp"
#include "tools/commands/run_plan.hpp"
#include "tools/commands/session_recorder.hpp"

namespace bladefit {

/// Where the words for the user go.
struct RunWords {
  explicit RunWords(std::FILE* to) : file(to), terminal(isatty(fileno(to)) == 1) {}
  std::FILE* file;
  bool terminal;
};

/// Writes what the session came to, also after a fault: then of the points stored before it. Whatever cannot be written
/// keeps nothing else from it. Returns the exit code.
[[nodiscard]] int conclude_run(const RunPlan& plan, Host& host, const RunWords& words, SessionRecorder& recorder);

}  // namespace bladefit
