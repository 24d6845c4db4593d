#include "tools/simulate/stamps.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstring>

#include "tools/files/tool_error.hpp"

namespace bladefit::simulate {

Stamps::Stamps(const std::string& path) {
  if (path.empty()) return;
  file_.reset(std::fopen(path.c_str(), "w"));
  if (!file_) {
    throw ToolError(fmt::format("--stamp {}: {}; give a path that can be written", path, std::strerror(errno)));
  }
}

void Stamps::note(std::uint32_t available) {
  if (!file_ || noted_ >= available) return;
  // The steady clock of this platform is CLOCK_MONOTONIC.
  const auto since_boot = std::chrono::steady_clock::now().time_since_epoch();
  const auto nanoseconds = std::chrono::duration_cast<std::chrono::nanoseconds>(since_boot).count();
  while (noted_ < available) fmt::print(file_.get(), "{},{}\n", ++noted_, nanoseconds);
  if (std::fflush(file_.get()) != 0) {
    throw ToolError(fmt::format("--stamp: cannot be written: {}; check free space", std::strerror(errno)),
                    ToolError::Kind::device);
  }
}

}  // namespace bladefit::simulate
