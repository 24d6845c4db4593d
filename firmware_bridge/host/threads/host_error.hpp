#pragma once
#include <cstdint>
#include <string>

namespace bladefit {

/// Which of the documented exit codes an error leads to.
enum class Fault : std::uint8_t {
  none = 0,
  bad_input,  ///< exit code 2: the user asked for something that cannot be
  device,     ///< exit code 3: a device, the disk or the network failed
};

/// What stopped the host: one line that names the file or address and the mend.
struct HostError {
  Fault fault = Fault::none;
  std::string message;
  [[nodiscard]] explicit operator bool() const { return fault != Fault::none; }
};

}  // namespace bladefit
