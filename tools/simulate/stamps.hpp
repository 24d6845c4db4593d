#pragma once
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

namespace bladefit::simulate {

/// File of lines `sequence,nanoseconds`: when (CLOCK_MONOTONIC) each record became readable, to measure latencies.
class Stamps {
 public:
  /// Empty path = no file. Throws ToolError (bad input) when it cannot be written.
  explicit Stamps(const std::string& path);

  /// Notes that every record up to `available` can be read as of now. A record shown again keeps its first stamp.
  void note(std::uint32_t available);

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::unique_ptr<std::FILE, CloseFile> file_;
  std::uint32_t noted_ = 0;
};

}  // namespace bladefit::simulate
