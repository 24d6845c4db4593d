#pragma once
#include <CLI/CLI.hpp>

namespace bladefit {

/// Adds `panel` to the commands: the operator's live screen of a session, or the register map. When it was run,
/// `exit_code` is 0 done, 2 bad address, 3 no panel at the address.
void add_panel_command(CLI::App& app, int& exit_code);

}  // namespace bladefit
