#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// Adds `localize` to the commands: the batch fit of a points file. When it was run, `exit_code` is 0 done, 1 out of
/// tolerance, 2 bad input, 3 I/O failure.
void add_localize_command(CLI::App& app, int& exit_code);

}  // namespace bladefit
