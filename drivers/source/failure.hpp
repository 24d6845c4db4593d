#pragma once
#include <cstdint>
#include <string>
#include <utility>

namespace bladefit {

/// Why something could not be done, or that it was. The one kind of failure outside of core: drivers, config and host
/// return it; tools throw it as ToolError.
struct [[nodiscard]] Failure {
  /// Whose the fault is; it decides about the exit code.
  enum class Kind : std::uint8_t {
    none,
    bad_input,  ///< exit code 2: what the user asked for, or what a file says, cannot be
    device,     ///< exit code 3: a device, the disk or the network failed
  };

  Kind kind = Kind::none;
  /// One line that names what failed (a file with line and field, a port, an address) and the fix. The parts of a
  /// driver return the phrase alone; whoever knows the name puts it in front.
  std::string message;

  [[nodiscard]] explicit operator bool() const { return kind != Kind::none; }
};

[[nodiscard]] inline Failure bad_input(std::string message) { return {Failure::Kind::bad_input, std::move(message)}; }

[[nodiscard]] inline Failure device_failure(std::string message) { return {Failure::Kind::device, std::move(message)}; }

}  // namespace bladefit
