#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// Adds `reproduce` to the commands: the tables of the thesis beside our figures on the stand-in data. When it was run,
/// `exit_code` is 0 done, 2 bad input, 3 I/O failure.
void add_reproduce_command(CLI::App& app, int& exit_code);

}  // namespace bladefit
