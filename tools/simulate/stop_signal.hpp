#pragma once
#include <csignal>

#include "tools/simulate/descriptor.hpp"

namespace bladefit::simulate {

/// Turns SIGINT and SIGTERM into an event of a descriptor for as long as it lives, and ignores SIGPIPE.
class StopSignal {
 public:
  /// Throws ToolError (device).
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_.get(); }

 private:
  sigset_t before_{};
  Descriptor descriptor_;
};

}  // namespace bladefit::simulate
