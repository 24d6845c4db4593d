#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// Adds `bladefit compile` to `app`. When it has run, `exit_code` is 0, 2 for bad input, or 3 for failed input or
/// output.
void add_compile_command(CLI::App& app, int& exit_code);

}  // namespace bladefit
