#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// Adds `simulate` to the commands: a simulated CMM that serves the points of a file. When it was run, `exit_code` is
/// 0 done, 2 bad input, 3 device failure.
void add_simulate_command(CLI::App& app, int& exit_code);

}  // namespace bladefit
