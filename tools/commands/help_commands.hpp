#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// `bladefit help [COMMAND]` and `bladefit completion SHELL`: what the command line says of itself. Added last: they
/// know the commands that are there before them.
void add_help_commands(CLI::App& app, int& exit_code);

}  // namespace bladefit
