#pragma once
#include <string>
#include <string_view>

namespace bladefit {

/// A file in memory with a name, for readers that take nothing else; it goes when this does.
class MemoryFile {
 public:
  /// Throws ToolError (device) where there is no memory left for it.
  explicit MemoryFile(std::string_view content);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::string path() const;

 private:
  int descriptor_;
};

}  // namespace bladefit
