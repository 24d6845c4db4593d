#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// Adds `bladefit report SESSION_DIR --format html|csv|json -o OUT`. Sets `exit_code`: 0 done, 2 wrong use, or a
/// session that cannot be reported, 3 the output cannot be written.
void add_report_command(CLI::App& app, int& exit_code);

}  // namespace bladefit
