#include "tools/commands/help_commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "tools/commands/option_texts.hpp"
#include "tools/commands/suggestion.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

struct HelpFlags {
  std::string command;
  bool manual = false;
};

void refuse_unknown(const CLI::App& app, const std::string& name) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == name) return;
    names.push_back(command->get_name());
  }
  throw ToolError("help: '" + name + "' is not a command" + suggestion(name, names) + "; `bladefit --help` lists them");
}

/// Once a command is chosen, the program's own help() is that of the command.
std::string help_of_all(const CLI::App& app) {
  return app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal);
}

void help(const CLI::App& app, const HelpFlags& flags) {
  if (!flags.command.empty()) refuse_unknown(app, flags.command);
  if (flags.manual) {
    fmt::print("{}", manual_page(app, flags.command));
  } else {
    fmt::print("{}", flags.command.empty() ? help_of_all(app) : app.get_subcommand(flags.command)->help("bladefit"));
  }
}

}  // namespace

void add_help_commands(CLI::App& app, int& exit_code) {
  const auto flags = std::make_shared<HelpFlags>();
  CLI::App* const command = app.add_subcommand("help", "explain a command");
  command->add_option("command", flags->command, "the command; all of them where none is given")->type_name("COMMAND");
  command->add_flag("--man", flags->manual, "as a manual page: bladefit help run --man | man -l -");
  command->callback([&app, flags, &exit_code] {
    help(app, *flags);
    exit_code = 0;
  });

  const auto shell = std::make_shared<std::string>();
  CLI::App* const completion =
      app.add_subcommand("completion", "print the script by which a shell completes commands and options");
  completion->add_option("shell", *shell, "bash or zsh")->required()->check(CLI::IsMember({"bash", "zsh"}));
  completion->footer("\nExample:\n  source <(bladefit completion bash)");
  completion->callback([&app, shell, &exit_code] {
    fmt::print("{}", completion_script(app, *shell));
    exit_code = 0;
  });
}

}  // namespace bladefit
