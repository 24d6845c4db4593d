#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// Adds `sample` to the commands: points of a design surface. When it was run, `exit_code` is 0
/// done, 2 bad input, 3 I/O failure.
void add_sample_command(CLI::App& app, int& exit_code);

}  // namespace bladefit
