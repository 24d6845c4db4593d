#pragma once
#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace bladefit {

/// The path of a program that the search path (PATH) has; nothing where it has none.
[[nodiscard]] std::optional<std::string> find_program(const std::string& name);

/// Runs a program, by its path and its arguments, with no input and its output thrown away. Returns its exit code,
/// 128 + the signal that ended it, or nothing where it cannot be started or does not end within `longest`, when it is
/// killed.
[[nodiscard]] std::optional<int> run_program(const std::string& path, const std::vector<std::string>& arguments,
                                             std::chrono::seconds longest);

}  // namespace bladefit
