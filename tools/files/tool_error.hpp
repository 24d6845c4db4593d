#pragma once
#include <stdexcept>
#include <string>

#include "tools/files/exit_codes.hpp"

namespace bladefit {

/// Why a design could not be read, compiled or written. what() is one line that names the file, the entity, line or
/// field, and the fix.
class ToolError : public std::runtime_error {
 public:
  enum class Kind {
    bad_input,   ///< wrong use or wrong content
    io_failure,  ///< the operating system refused to read or write
  };

  explicit ToolError(const std::string& message, Kind kind = Kind::bad_input)
      : std::runtime_error(message), kind_(kind) {}

  [[nodiscard]] Kind kind() const { return kind_; }

  /// Exit code of the command line: 2 bad input, 3 failed input or output.
  [[nodiscard]] int exit_code() const { return kind_ == Kind::io_failure ? kDeviceFailure : kBadInput; }

 private:
  Kind kind_;
};

}  // namespace bladefit
