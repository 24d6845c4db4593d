#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>

#include "tools/commands/compile_command.hpp"
#include "tools/commands/localize_command.hpp"
#include "tools/commands/loft_command.hpp"
#include "tools/commands/panel_command.hpp"
#include "tools/commands/report_command.hpp"
#include "tools/commands/reproduce_command.hpp"
#include "tools/commands/run_command.hpp"
#include "tools/commands/sample_command.hpp"
#include "tools/commands/simulate_command.hpp"
#include "tools/commands/split_command.hpp"
#include "tools/files/exit_codes.hpp"
#include "tools/files/message.hpp"
#include "tools/files/tool_error.hpp"

namespace {

constexpr const char* kFooter =
    "A first try:\n"
    "  bladefit localize --design blade.igs --points points.csv --leading-edge u:0.4:0.6 --tolerance 0.1 --json "
    "out.json\n"
    "Exit codes: 0 done, in tolerance or nothing to judge, 1 the blade is out of tolerance, 2 wrong use or bad input, "
    "3 "
    "device or I/O failure, 4 not decided: the reasons stand below the verdict.";

void tell(const std::string& message) { std::fprintf(stderr, "bladefit: %s\n", bladefit::one_line(message).c_str()); }

/// What is wrong with the command line. Of a value that is no number the parser says `--ratio = abc`.
std::string words_of(const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::size_t place = text.find(": "), equal = text.find(" = ");
  const bool conversion = dynamic_cast<const CLI::ConversionError*>(&error) != nullptr;
  if (!conversion || place == std::string::npos || equal == std::string::npos) return text;
  return text.substr(place + 2, equal - place - 2) + ": '" + text.substr(equal + 3) + "' is not a number";
}

/// Takes the command line apart and runs what it asks for; returns the exit code.
int run(int argc, char** argv) {
  CLI::App app("bladefit: live localization of marine propeller blades on a coordinate measuring machine", "bladefit");
  app.require_subcommand(1);
  app.footer(kFooter);
  int exit_code = 0;
  bladefit::add_loft_command(app, exit_code);
  bladefit::add_split_command(app, exit_code);
  bladefit::add_sample_command(app, exit_code);
  bladefit::add_compile_command(app, exit_code);
  bladefit::add_localize_command(app, exit_code);
  bladefit::add_simulate_command(app, exit_code);
  bladefit::add_run_command(app, exit_code);
  bladefit::add_panel_command(app, exit_code);
  bladefit::add_report_command(app, exit_code);
  bladefit::add_reproduce_command(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    const std::string first = argc > 1 ? argv[1] : "";
    const auto named = [&first](const CLI::App* command) { return command->get_name() == first; };
    if (!first.empty() && first.front() != '-' && app.get_subcommands(named).empty()) {
      tell("'" + first + "' is no command; `bladefit --help` lists them");
      return bladefit::kBadInput;
    }
    tell(words_of(error) + "; `bladefit --help` and `bladefit COMMAND --help` list what there is");
    return bladefit::kBadInput;
  }
  return exit_code;
}

/// What was printed is out only when the stream has been emptied: a full disk shows here at the latest.
int checked_output(int exit_code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  tell("standard output: cannot be written; check free space, or what reads it");
  return bladefit::kDeviceFailure;
}

/// Runs the command; what ends it early is told in one line.
int run_and_tell(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const bladefit::ToolError& error) {
    tell(error.what());
    return error.exit_code();
  } catch (const std::bad_alloc&) {
    tell("there is not enough memory for this; give fewer points, or a smaller design");
  } catch (const std::filesystem::filesystem_error& error) {
    tell(error.path1().string() + ": " + error.code().message() + "; check the name and its permissions");
  } catch (const std::system_error& error) {
    // A stream that failed is told of when it is closed.
    if (std::ferror(stdout) == 0)
      tell("the system refuses: " + error.code().message() + "; check disk, memory and permissions");
  } catch (const std::exception&) {
    tell("an unexpected fault in bladefit; please report the command and its files");
    return bladefit::kBadInput;
  }
  return bladefit::kDeviceFailure;
}

}  // namespace

int main(int argc, char** argv) { return checked_output(run_and_tell(argc, argv)); }
