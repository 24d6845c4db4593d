#include <cerrno>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include "tools/commands/command_line.hpp"
#include "tools/files/exit_codes.hpp"
#include "tools/files/message.hpp"
#include "tools/files/tool_error.hpp"

namespace {

/// What was printed is out only when the stream has been emptied: a full disk shows here at the latest. One that nobody
/// reads any more was given up by its reader, and is no failure.
int checked_output(int exit_code) {
  const bool failed_before = std::ferror(stdout) != 0;
  errno = 0;
  if (std::fflush(stdout) == 0 && !failed_before) return exit_code;
  if (!failed_before && errno == EPIPE) return exit_code;
  bladefit::tell("standard output: cannot be written; check free space, or what reads it");
  return bladefit::kDeviceFailure;
}

/// Runs the command; what ends it early is told in one line.
int run_and_tell(int argc, char** argv) {
  try {
    return bladefit::run_command_line(argc, argv);
  } catch (const bladefit::ToolError& error) {
    bladefit::tell(error.what());
    return error.exit_code();
  } catch (const std::bad_alloc&) {
    bladefit::tell("there is not enough memory for this; give fewer points, or a smaller design");
  } catch (const std::filesystem::filesystem_error& error) {
    bladefit::tell(error.path1().string() + ": " + error.code().message() + "; check the name and its permissions");
  } catch (const std::system_error& error) {
    // A stream that failed is told of when it is closed.
    if (std::ferror(stdout) == 0)
      bladefit::tell("the system refuses: " + error.code().message() + "; check disk, memory and permissions");
  } catch (const std::exception&) {
    bladefit::tell("an unexpected fault in bladefit; please report the command and its files");
    return bladefit::kBadInput;
  }
  return bladefit::kDeviceFailure;
}

}  // namespace

int main(int argc, char** argv) { return checked_output(run_and_tell(argc, argv)); }
