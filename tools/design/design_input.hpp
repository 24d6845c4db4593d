#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace bladefit {

/// Design files by name, where "-" is standard input: what comes there stands in a file of its own while this object
/// lives, since what reads CAD files wants one. Its kind follows from its content.
class DesignInput {
 public:
  /// Reads standard input where it is named. Throws ToolError where that fails, is named twice, or is packed.
  explicit DesignInput(std::vector<std::filesystem::path> names);
  ~DesignInput();
  DesignInput(const DesignInput&) = delete;
  DesignInput& operator=(const DesignInput&) = delete;

  /// The names, with that of the file for "-".
  [[nodiscard]] const std::vector<std::filesystem::path>& paths() const { return paths_; }

 private:
  void keep(const std::string& content);

  std::vector<std::filesystem::path> paths_;
  std::filesystem::path folder_;  ///< empty where nothing is kept
};

}  // namespace bladefit
