#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// Adds `run` to the commands: a live session from a machine or a recording. When it was run, `exit_code` is 0 in
/// tolerance, 1 out of tolerance, 2 wrong use or bad input, 3 device or I/O failure, also where one of the files could
/// not be written, 4 not decided.
void add_run_command(CLI::App& app, int& exit_code);

}  // namespace bladefit
