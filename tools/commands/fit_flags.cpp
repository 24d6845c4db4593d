#include "tools/commands/fit_flags.hpp"

#include <algorithm>
#include <string>
#include <type_traits>
#include <variant>

#include "config/zone_table.hpp"
#include "tools/commands/length_flag.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// The flag of one option; what it is given is parsed at once.
template <typename Kind>
CLI::Option* add_flag(CLI::App& command, const FitOption& option, const Kind& kind, FitSettings& flags) {
  using Given = typename Kind::Given;
  const std::string flag = flag_of(option), help(option.help);
  const auto take = [flag, &kind, &flags](const Given& given) {
    if (const Failure error = set(kind, given, flags)) throw ToolError(flag + ": " + error.message);
  };
  if constexpr (std::is_same_v<Given, Length>) {
    return add_length_flag(command, flag, take, help);
  } else if constexpr (std::is_same_v<Given, bool>) {
    return command.add_flag_callback(
        flag, [take] { take(true); }, help);
  } else {
    return command.add_option_function<Given>(flag, take, help)->allow_extra_args(false);
  }
}

/// The tables [[zone]] of a file of their own.
CLI::Option* add_zones_flag(CLI::App& command, FitSettings& flags) {
  const auto take = [&flags](const std::string& path) {
    if (const Failure error = load_zones(path, flags.zones)) throw ToolError(error);
    flags.zones_file = path;
  };
  return command
      .add_option_function<std::string>(
          "--zones", take,
          "TOML file with tables [[zone]]: parts of the blade with plus and minus tolerances of their own, in place of "
          "--leading-edge and --tolerance (see config/fit.toml)")
      ->type_name("FILE.toml")
      ->allow_extra_args(false);
}

}  // namespace

void add_fit_options(CLI::App& command, FitSettings& flags) {
  add_zones_flag(command, flags)->group("Fit");
  for (const FitOption& option : fit_options()) {
    std::visit([&](const auto& kind) { add_flag(command, option, kind, flags)->group("Fit"); }, option.kind);
  }
}

void add_fit_options(CLI::App& command, FitSettings& flags, std::span<const std::string_view> keys) {
  if (std::ranges::find(keys, "leading_edge") != keys.end()) add_zones_flag(command, flags)->group("Design");
  for (const FitOption& option : fit_options()) {
    if (std::ranges::find(keys, option.key) == keys.end()) continue;
    std::visit([&](const auto& kind) { add_flag(command, option, kind, flags)->group("Design"); }, option.kind);
  }
}

}  // namespace bladefit
