#include "tools/files/read_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "drivers/text/read_file.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// Designs of whole ships stay below it.
constexpr std::size_t kMaxFileSize = std::size_t{1} << 29U;

}  // namespace

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

std::string read_text(const std::filesystem::path& path, std::string_view what) {
  std::string text;
  const Failure failure = read_file(path.string(), kMaxFileSize, text);
  if (!failure) return text;
  throw ToolError(fmt::format("{}: {}{}", file_name(path.string()), failure.message,
                              failure.kind == Failure::Kind::bad_input ? fmt::format(" (the {})", what) : ""),
                  failure.kind);
}

}  // namespace bladefit
