#pragma once
#include <string>

namespace bladefit {

/// Why settings cannot be used. `message` is one line that names file, line and key (or the option) and the mend.
struct ConfigError {
  std::string message;
  [[nodiscard]] explicit operator bool() const { return !message.empty(); }
};

}  // namespace bladefit
