#include "tools/commands/option_texts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <map>
#include <variant>
#include <vector>

#include "config/fit_option.hpp"
#include "drivers/text/units.hpp"

namespace bladefit {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> flags_of(const CLI::App& command) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
    for (const std::string& name : option->get_snames()) flags.push_back("-" + name);
  }
  return flags;
}

/// The words that an option of the fit takes, by flag.
std::map<std::string, std::string> choices() {
  std::map<std::string, std::string> words;
  for (const FitOption& option : fit_options()) {
    std::visit(
        [&](const auto& kind) {
          if constexpr (requires { kind.words; })
            words[flag_of(option)] = fmt::format("{}", fmt::join(kind.words, " "));
        },
        option.kind);
  }
  return words;
}

std::string bash_script(const CLI::App& app) {
  std::vector<std::string> names;
  std::string cases;
  for (const CLI::App* command : commands_of(app)) {
    names.push_back(command->get_name());
    cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(), fmt::join(flags_of(*command), " "));
  }
  std::string values;
  for (const auto& [flag, words] : choices()) values += fmt::format("    {}) words=\"{}\" ;;\n", flag, words);
  return fmt::format(
      "# bash completion of bladefit: source <(bladefit completion bash)\n"
      "_bladefit() {{\n"
      "  local current=${{COMP_WORDS[COMP_CWORD]}} words=\"\"\n"
      "  if [[ $COMP_CWORD -eq 1 ]]; then\n"
      "    COMPREPLY=($(compgen -W \"{} --help --version\" -- \"$current\"))\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[COMP_CWORD - 1]}} in\n{}"
      "    *) [[ $current != -* ]] || case ${{COMP_WORDS[1]}} in\n{}    esac ;;\n"
      "  esac\n"
      "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
      "}}\n"
      "complete -o default -F _bladefit bladefit\n",
      fmt::join(names, " "), values, cases);
}

/// A text between single quotes of the shell, in which _describe ends a word at a colon.
std::string described(const std::string& name, const std::string& text) {
  std::string out = "'" + name + ":";
  for (const char letter : text) {
    if (letter == '\'') {
      out += "'\\''";
    } else {
      out += letter == '\n' ? ' ' : letter;
    }
  }
  return out + "'";
}

std::string zsh_script(const CLI::App& app) {
  std::string names, cases, values;
  for (const CLI::App* command : commands_of(app)) {
    names += "    " + described(command->get_name(), command->get_description()) + "\n";
    std::string flags;
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& name : option->get_lnames()) {
        flags += "      " + described("--" + name, option->get_description()) + "\n";
      }
    }
    cases += fmt::format("    {}) options=(\n{}    ) ;;\n", command->get_name(), flags);
  }
  for (const auto& [flag, words] : choices()) values += fmt::format("    {}) compadd {}; return ;;\n", flag, words);
  return fmt::format(
      "#compdef bladefit\n"
      "# zsh completion of bladefit: bladefit completion zsh > a folder of $fpath/_bladefit\n"
      "_bladefit() {{\n"
      "  local -a commands options\n"
      "  commands=(\n{}  )\n"
      "  if (( CURRENT == 2 )); then _describe command commands; return; fi\n"
      "  case $words[CURRENT-1] in\n{}  esac\n"
      "  if [[ $words[CURRENT] != -* ]]; then _files; return; fi\n"
      "  case $words[2] in\n{}  esac\n"
      "  _describe option options\n"
      "}}\n"
      "compdef _bladefit bladefit\n",
      names, values, cases);
}

/// A text for roff: lines that begin with a dot, and backslashes, mean themselves.
std::string roff(const std::string& text) {
  std::string out;
  for (const char letter : text) {
    if ((out.empty() || out.back() == '\n') && (letter == '.' || letter == '\'')) out += "\\&";
    if (letter == '-' || letter == '\\') out += letter == '-' ? "\\" : "\\e";
    if (letter != '\\') out += letter;
  }
  return out;
}

std::string manual_options(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name();
    text += fmt::format(".TP\n.B {}\n{}\n", roff(option->get_name(true, true) + (type.empty() ? "" : " " + type)),
                        roff(option->get_description()));
  }
  return text;
}

std::string manual_commands(const CLI::App& app) {
  std::string text = ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app)) {
    text += fmt::format(".TP\n.B {}\n{}\n", command->get_name(), roff(command->get_description()));
  }
  return text;
}

}  // namespace

std::string completion_script(const CLI::App& app, const std::string& shell) {
  return shell == "bash" ? bash_script(app) : zsh_script(app);
}

std::string manual_page(const CLI::App& app, const std::string& command) {
  const CLI::App& shown = command.empty() ? app : *app.get_subcommand(command);
  const std::string name = command.empty() ? "bladefit" : "bladefit-" + command;
  std::string title = name;
  for (char& letter : title) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  std::string text = fmt::format(
      ".TH {} 1 \"\" \"bladefit {}\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B bladefit{}\n[OPTIONS]\n.SH OPTIONS\n{}",
      roff(title), BLADEFIT_VERSION, roff(name), roff(shown.get_description()), command.empty() ? "" : " " + command,
      manual_options(shown));
  if (command.empty()) text += manual_commands(app);
  if (!shown.get_footer().empty()) text += ".SH NOTES\n.nf\n" + roff(shown.get_footer()) + "\n.fi\n";
  return text;
}

}  // namespace bladefit
