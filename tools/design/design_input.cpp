#include "tools/design/design_input.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "core/geometry/surface/design_image.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

namespace fs = std::filesystem;

/// The extension of a file with this content: of IGES where it is no other.
const char* extension_of(std::string_view content) {
  constexpr std::size_t kFirst = 200;
  if (content.starts_with(std::string_view(kImageMagic, sizeof kImageMagic))) return ".bfd";
  if (content.substr(0, kFirst).find("ISO-10303-21") != std::string_view::npos) return ".stp";
  if (content.starts_with("\x1f\x8b") || content.starts_with("PK"))
    throw ToolError("standard input: the design is packed; unpack it, or give it as a file");
  return ".igs";
}

}  // namespace

DesignInput::DesignInput(std::vector<fs::path> names) : paths_(std::move(names)) {
  const auto input = std::ranges::count(paths_, fs::path("-"));
  if (input == 0) return;
  if (input > 1) throw ToolError("standard input holds one design; name the others as files");
  keep(read_text("-"));
}

void DesignInput::keep(const std::string& content) {
  const char* const extension = extension_of(content);
  std::string name = (fs::temp_directory_path() / "bladefit-design-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw ToolError(device_failure(fmt::format("{}: {}", name, std::strerror(errno))));
  folder_ = name;
  const fs::path path = folder_ / (std::string("standard-input") + extension);
  std::ofstream file(path, std::ios::binary);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) throw ToolError(device_failure(fmt::format("{}: cannot be written; make room", path.string())));
  std::ranges::replace(paths_, fs::path("-"), path);
}

DesignInput::~DesignInput() {
  std::error_code error;
  if (!folder_.empty()) fs::remove_all(folder_, error);
}

}  // namespace bladefit
