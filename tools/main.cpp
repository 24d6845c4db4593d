#include <cstdio>
#include <exception>

#include "tools/commands/command_line.hpp"
#include "tools/files/exit_codes.hpp"
#include "tools/files/tool_error.hpp"

int main(int argc, char** argv) {
  try {
    return bladefit::run_command_line(argc, argv);
  } catch (const bladefit::ToolError& error) {
    std::fprintf(stderr, "bladefit: %s\n", error.what());
    return error.exit_code();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bladefit: %s\n", error.what());
    return bladefit::kBadInput;
  }
}
