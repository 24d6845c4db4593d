#pragma once
#include <filesystem>
#include <string>

namespace bladefit {

/// The content of a CAD file of text, without a byte order mark, unpacked where it is compressed. Throws ToolError as
/// read_text and unpacked do, and before anything is read for what is no file (a device), is over 512 MB, or begins as
/// a file of another kind, with the way on.
std::string read_design_text(const std::filesystem::path& path);

}  // namespace bladefit
