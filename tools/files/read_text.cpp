#include "tools/files/read_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

#include "tools/files/tool_error.hpp"

namespace bladefit {

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

std::string read_text(const std::filesystem::path& path, std::string_view what) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw ToolError(fmt::format("{}: no such file; check the name", path.string()));
  }
  if (std::filesystem::is_directory(status)) {
    throw ToolError(fmt::format("{}: is a folder; name the {} file in it", path.string(), what));
  }
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) {
    throw ToolError(fmt::format("{}: cannot be read; check its permissions", path.string()), ToolError::Kind::device);
  }
  return text;
}

}  // namespace bladefit
