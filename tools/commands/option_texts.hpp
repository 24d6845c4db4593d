#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace bladefit {

/// Scripts by which a shell completes commands, options and their words, made from the command line itself. `shell` is
/// bash or zsh.
[[nodiscard]] std::string completion_script(const CLI::App& app, const std::string& shell);

/// The manual page of a command, or of the program where `command` is empty, as roff for man(1).
[[nodiscard]] std::string manual_page(const CLI::App& app, const std::string& command);

}  // namespace bladefit
