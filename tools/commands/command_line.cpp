#include "tools/commands/command_line.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "tools/commands/compile_command.hpp"
#include "tools/commands/localize_command.hpp"
#include "tools/commands/loft_command.hpp"
#include "tools/commands/panel_command.hpp"
#include "tools/commands/recover_command.hpp"
#include "tools/commands/report_command.hpp"
#include "tools/commands/reproduce_command.hpp"
#include "tools/commands/run_command.hpp"
#include "tools/commands/sample_command.hpp"
#include "tools/commands/show_command.hpp"
#include "tools/commands/simulate_command.hpp"
#include "tools/commands/split_command.hpp"
#include "tools/files/exit_codes.hpp"
#include "tools/files/message.hpp"

namespace bladefit {
namespace {

constexpr const char* kFooter =
    "A first try:\n"
    "  bladefit localize --design blade.igs --points points.csv --leading-edge u:0.4:0.6 --tolerance 0.1 --json "
    "out.json\n"
    "Exit codes: 0 done, in tolerance or nothing to judge, 1 the blade is out of tolerance, 2 wrong use or bad input, "
    "3 "
    "device or I/O failure, 4 not decided: the reasons stand below the verdict.";

/// What is wrong with the command line. Of a value that is no number the parser says `--ratio = abc`.
std::string words_of(const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::size_t place = text.find(": "), equal = text.find(" = ");
  const bool conversion = dynamic_cast<const CLI::ConversionError*>(&error) != nullptr;
  if (!conversion || place == std::string::npos || equal == std::string::npos) return text;
  return text.substr(place + 2, equal - place - 2) + ": '" + text.substr(equal + 3) + "' is not a number";
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app("bladefit: live localization of marine propeller blades on a coordinate measuring machine", "bladefit");
  app.require_subcommand(1);
  app.footer(kFooter);
  int exit_code = 0;
  add_loft_command(app, exit_code);
  add_split_command(app, exit_code);
  add_sample_command(app, exit_code);
  add_compile_command(app, exit_code);
  add_show_command(app, exit_code);
  add_localize_command(app, exit_code);
  add_simulate_command(app, exit_code);
  add_run_command(app, exit_code);
  add_panel_command(app, exit_code);
  add_report_command(app, exit_code);
  add_recover_command(app, exit_code);
  add_reproduce_command(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    const std::string first = argc > 1 ? argv[1] : "";
    const auto named = [&first](const CLI::App* command) { return command->get_name() == first; };
    if (!first.empty() && first.front() != '-' && app.get_subcommands(named).empty()) {
      tell("'" + first + "' is no command; `bladefit --help` lists them");
      return kBadInput;
    }
    tell(words_of(error) + "; `bladefit --help` and `bladefit COMMAND --help` list what there is");
    return kBadInput;
  }
  return exit_code;
}

}  // namespace bladefit
