#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// bladefit memory: the block of memory that a fit needs, by part. `exit_code` becomes what the command returns.
void add_memory_command(CLI::App& app, int& exit_code);

}  // namespace bladefit
