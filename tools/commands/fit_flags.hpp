#pragma once
#include <CLI/CLI.hpp>
#include <span>
#include <string_view>

#include "config/fit_option.hpp"

namespace bladefit {

/// Adds a flag for each row of fit_options(), which `localize` and `run` share; what is given on the command line goes
/// to `flags`. A value that cannot be used throws ToolError while the command line is read.
void add_fit_options(CLI::App& command, FitSettings& flags);

/// The same for the options of these keys alone, for a command that needs no more of a fit.
void add_fit_options(CLI::App& command, FitSettings& flags, std::span<const std::string_view> keys);

}  // namespace bladefit
