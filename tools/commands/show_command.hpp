#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// Adds `bladefit show`; `exit_code` receives its exit code once it has run.
void add_show_command(CLI::App& app, int& exit_code);

}  // namespace bladefit
