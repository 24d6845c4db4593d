#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// Adds `recover` to the commands: the good records of a damaged journal. When it was run, `exit_code` is 0 where every
/// record is whole, 2 wrong use or nothing to recover, 3 I/O failure, 4 where records are lost.
void add_recover_command(CLI::App& app, int& exit_code);

}  // namespace bladefit
