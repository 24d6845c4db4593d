#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace bladefit {

/// The extension of `path` in lower case, with its dot.
std::string lower_extension(const std::filesystem::path& path);

/// The whole file; `what` says in messages what is in it. Throws ToolError: bad_input where it does not exist or is a
/// folder, `device` where reading fails.
std::string read_text(const std::filesystem::path& path, std::string_view what = "design");

}  // namespace bladefit
