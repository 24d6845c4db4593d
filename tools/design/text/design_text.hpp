#pragma once
#include <filesystem>
#include <string>

namespace bladefit {

/// The content of a CAD file of text, without a byte order mark. Throws ToolError as read_text does, and before
/// anything is read for what is no file (a device), is over 256 MB, or begins as a file of another kind, with the way
/// on.
std::string read_design_text(const std::filesystem::path& path);

}  // namespace bladefit
