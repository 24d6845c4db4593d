#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "config/length.hpp"

namespace bladefit {

/// An option that takes a length with or without a unit of its own. What it is given is parsed at once and handed to
/// `take`; an error (ToolError) names the flag.
CLI::Option* add_length_flag(CLI::App& command, const std::string& flag, const std::function<void(const Length&)>& take,
                             const std::string& help);

}  // namespace bladefit
