#pragma once
#include <string>

#include "drivers/source/failure.hpp"

namespace bladefit {

/// Sole use of a serial port: an advisory lock that every bladefit takes, and the port's own exclusive mode, which
/// keeps other programs out. Two readers of one port would each get a part of the bytes.
class PortGuard {
 public:
  PortGuard() = default;
  PortGuard(const PortGuard&) = delete;
  PortGuard& operator=(const PortGuard&) = delete;
  ~PortGuard() { release(); }

  /// Locks the port at `device`. Failure `device`: one phrase with the fix where it is missing, busy, forbidden or no
  /// serial port.
  [[nodiscard]] Failure lock(const std::string& device);

  /// Shuts out later openers. To be called once everything of this process has the port open.
  void shut_out_others() const;

  /// Asks the adapter's driver to pass on bytes at once. Returns a remark where its latency timer stays long.
  [[nodiscard]] std::string ask_low_latency() const;

  void release();

  /// The port, open without blocking for reading and writing; -1 = not locked.
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  std::string device_;
  int descriptor_ = -1;
};

/// What an errno of opening a serial port means, with the fix.
[[nodiscard]] std::string port_error_text(int error);

}  // namespace bladefit
