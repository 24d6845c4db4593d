#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// Adds `loft` to the commands: a design surface from the points of blade sections. When it was run, `exit_code` is 0
/// done, 2 bad input, 3 I/O failure.
void add_loft_command(CLI::App& app, int& exit_code);

}  // namespace bladefit
