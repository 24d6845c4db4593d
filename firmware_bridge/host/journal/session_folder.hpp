#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "drivers/source/failure.hpp"

namespace bladefit {

/// The folder of a session. Those folders that make() had to make go again with this object when nothing is in them.
class SessionFolder {
 public:
  SessionFolder() = default;
  SessionFolder(const SessionFolder&) = delete;
  SessionFolder& operator=(const SessionFolder&) = delete;
  ~SessionFolder();

  /// Makes the folder and those above it where they are missing. `device`: it cannot be made.
  [[nodiscard]] Failure make(const std::string& path);

 private:
  std::vector<std::filesystem::path> made_;  ///< innermost first
};

}  // namespace bladefit
