#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace bladefit {

/// The extension of `path` in lower case, with its dot.
std::string lower_extension(const std::filesystem::path& path);

/// The whole file, up to 512 MiB, or standard input where `path` is "-"; `what` says in messages what is in it. Throws
/// ToolError as read_file() fails.
std::string read_text(const std::filesystem::path& path, std::string_view what = "design");

}  // namespace bladefit
