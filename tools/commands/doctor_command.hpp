#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// bladefit doctor: does a configuration fit the real device? `exit_code` becomes what the command returns.
void add_doctor_command(CLI::App& app, int& exit_code);

}  // namespace bladefit
