#pragma once
#include <string>
#include <string_view>

namespace bladefit::fuzz {

/// A file in memory, for readers that take a path.
class MemoryFile {
 public:
  /// Throws std::runtime_error where the system has none left.
  explicit MemoryFile(std::string_view content);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::string path() const;

 private:
  int descriptor_;
};

}  // namespace bladefit::fuzz
