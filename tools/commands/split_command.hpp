#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// Adds `split` to the commands: a design cut exactly into patches. When it was run, `exit_code` is 0
/// done, 2 bad input, 3 I/O failure.
void add_split_command(CLI::App& app, int& exit_code);

}  // namespace bladefit
