#include "tools/commands/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "tools/commands/compile_command.hpp"
#include "tools/commands/decimal_numbers.hpp"
#include "tools/commands/doctor_command.hpp"
#include "tools/commands/help_commands.hpp"
#include "tools/commands/localize_command.hpp"
#include "tools/commands/loft_command.hpp"
#include "tools/commands/memory_command.hpp"
#include "tools/commands/panel_command.hpp"
#include "tools/commands/recover_command.hpp"
#include "tools/commands/report_command.hpp"
#include "tools/commands/reproduce_command.hpp"
#include "tools/commands/run_command.hpp"
#include "tools/commands/sample_command.hpp"
#include "tools/commands/show_command.hpp"
#include "tools/commands/simulate_command.hpp"
#include "tools/commands/split_command.hpp"
#include "tools/commands/suggestion.hpp"
#include "tools/commands/version_text.hpp"
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

/// What is wrong with the command line. Of a value that is no number the parser says `--ratio = abc`, of an option that
/// is given twice `--ratio: At Most 1 required but received 2`.
std::string words_of(const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::size_t place = text.find(": "), equal = text.find(" = ");
  if (const std::size_t most = text.find(": At Most 1 required but received "); most != std::string::npos)
    return text.substr(0, most) + ": is given more than once; give it once";
  const bool conversion = dynamic_cast<const CLI::ConversionError*>(&error) != nullptr;
  if (!conversion || place == std::string::npos || equal == std::string::npos) return text;
  return text.substr(place + 2, equal - place - 2) + ": '" + text.substr(equal + 3) + "' is not a number";
}

std::vector<std::string> names_of_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

/// "'--tolerence' is not an option of localize (did you mean --tolerance?)" for the first word that has no meaning
/// there; empty where each has one.
std::string unknown_option(const CLI::App& app) {
  const CLI::App& command = app.get_subcommands().empty() ? app : *app.get_subcommands().front();
  std::vector<std::string> flags;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
  }
  for (const std::string& word : command.remaining()) {
    const std::string flag = word.substr(0, word.find('='));
    if (flag.size() < 2 || flag.front() != '-') continue;
    return "'" + flag + "' is not an option of " + command.get_name() + suggestion(flag, flags);
  }
  return "";
}

/// What is wrong, and where the right words stand.
int refuse(const CLI::App& app, const CLI::ParseError& error, const std::string& first) {
  const std::vector<std::string> names = names_of_commands(app);
  if (!first.empty() && first.front() != '-' && std::ranges::find(names, first) == names.end()) {
    tell("'" + first + "' is not a command" + suggestion(first, names) + "; `bladefit --help` lists them");
    return kBadInput;
  }
  const std::string unknown = unknown_option(app);
  tell((unknown.empty() ? words_of(error) : unknown) +
       "; `bladefit --help` and `bladefit COMMAND --help` list what there is");
  return kBadInput;
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app("bladefit: live localization of marine propeller blades on a coordinate measuring machine", "bladefit");
  app.require_subcommand(0, 1);
  app.footer(kFooter);
  app.set_version_flag("--version", version_text,
                       "Print version and commit, and what of processor and CAD library is used");
  int exit_code = 0;
  add_loft_command(app, exit_code);
  add_split_command(app, exit_code);
  add_sample_command(app, exit_code);
  add_compile_command(app, exit_code);
  add_show_command(app, exit_code);
  add_localize_command(app, exit_code);
  add_simulate_command(app, exit_code);
  add_memory_command(app, exit_code);
  add_doctor_command(app, exit_code);
  add_run_command(app, exit_code);
  add_panel_command(app, exit_code);
  add_report_command(app, exit_code);
  add_recover_command(app, exit_code);
  add_reproduce_command(app, exit_code);
  add_help_commands(app, exit_code);
  take_decimal_numbers(app);
  if (argc == 1) {
    fmt::print("{}", app.help());
    return 0;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return refuse(app, error, argv[1]);
  }
  return exit_code;
}

}  // namespace bladefit
