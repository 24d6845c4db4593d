#pragma once

namespace bladefit {

/// Takes the command line apart and runs what it asks for; returns the exit code. Throws ToolError.
int run_command_line(int argc, char** argv);

}  // namespace bladefit
