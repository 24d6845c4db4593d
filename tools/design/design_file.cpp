#include "tools/design/design_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

#include "tools/design/iges/iges_reader.hpp"
#include "tools/design/step/step_reader.hpp"

namespace bladefit {
namespace {

DesignFile read_unchecked(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".igs" || extension == ".iges") return read_iges(path);
  if (extension == ".stp" || extension == ".step") return read_step(path);
  throw DesignError(fmt::format("{}: unknown kind of design \"{}\"; give a file named .igs, .iges, .stp or .step",
                                path.string(), extension));
}

}  // namespace

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
    throw DesignError(fmt::format("{}: no such file; check the name", path.string()));
  }
  if (std::filesystem::is_directory(status)) {
    throw DesignError(fmt::format("{}: is a folder; name the {} file in it", path.string(), what));
  }
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) {
    throw DesignError(fmt::format("{}: cannot be read; check its permissions", path.string()),
                      DesignError::Kind::io_failure);
  }
  return text;
}

DesignFile read_design(const std::filesystem::path& path) {
  DesignFile design = read_unchecked(path);
  for (NurbsSurface& surface : design.surfaces) {
    const std::vector<std::string> notes = check_surface(surface, path.string());
    design.warnings.insert(design.warnings.end(), notes.begin(), notes.end());
  }
  return design;
}

}  // namespace bladefit
