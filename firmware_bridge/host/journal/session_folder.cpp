#include "firmware_bridge/host/journal/session_folder.hpp"

#include <fmt/core.h>

#include <system_error>

namespace bladefit {

SessionFolder::~SessionFolder() {
  std::error_code not_empty;
  for (const std::filesystem::path& folder : made_) std::filesystem::remove(folder, not_empty);
}

Failure SessionFolder::make(const std::string& path) {
  std::error_code problem;
  std::vector<std::filesystem::path> missing;
  std::filesystem::path folder = std::filesystem::absolute(path).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  for (; folder.has_relative_path() && !std::filesystem::exists(folder, problem); folder = folder.parent_path()) {
    missing.push_back(folder);
  }
  std::filesystem::create_directories(path, problem);
  if (problem) {
    return device_failure(fmt::format("{}: the session folder cannot be made ({}); name another one with --session",
                                      path, problem.message()));
  }
  made_ = std::move(missing);
  return {};
}

}  // namespace bladefit
