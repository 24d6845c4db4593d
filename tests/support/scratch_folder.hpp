#pragma once
#include <filesystem>
#include <string>

namespace bladefit::testing {

/// A folder of a test's own, removed with everything in it.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }

  /// Writes a file and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& content) const;

 private:
  std::filesystem::path path_;
};

/// The bytes of a file; none where there is no such file.
std::string read_whole(const std::filesystem::path& path);

void write_whole(const std::filesystem::path& path, const std::string& content);

}  // namespace bladefit::testing
