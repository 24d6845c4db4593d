#pragma once
#include <span>
#include <string>
#include <string_view>

#include "config/option_kinds.hpp"
#include "core/localizer.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// Writes an option that is set to the configuration of the fit.
using ApplyOption = void (*)(const FitSettings& settings, double mm_per_unit, LocalizerConfig& config);

/// All there is to know of an option.
struct FitOption {
  std::string_view key;  ///< in TOML; the flag is "--" and the key with '-' for '_'
  FitOptionKind kind;
  ApplyOption apply;  ///< null: it is not for the localizer but for whoever loads the design, the points or the start
  std::string_view help;     ///< for --help and the shipped file: it names other options by words, not by flag or key
  std::string_view example;  ///< value in the shipped file
  bool active = false;       ///< whether the shipped file sets it; elsewhere it stands there behind a #
};

/// The table of the options, in the order of --help and the shipped file.
[[nodiscard]] std::span<const FitOption> fit_options();

/// The flag of an option: "--leading-edge".
[[nodiscard]] std::string flag_of(const FitOption& option);

/// `flags` where they are set, `file` elsewhere.
[[nodiscard]] FitSettings merged(const FitSettings& flags, const FitSettings& file);

/// Writes every option that is set to `config`, lengths turned to mm. What fields ask of each other is left to
/// check_config().
void apply_fit_options(const FitSettings& settings, double mm_per_unit, LocalizerConfig& config);

}  // namespace bladefit
