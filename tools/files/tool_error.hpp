#pragma once
#include <algorithm>
#include <stdexcept>
#include <string>

#include "drivers/source/failure.hpp"
#include "tools/files/exit_codes.hpp"

namespace bladefit {

/// A Failure on its way up: what ends a command. what() is one line that names the file, the entity, line or field, and
/// the fix.
class ToolError : public std::runtime_error {
 public:
  using Kind = Failure::Kind;

  /// bad_input: wrong use or wrong content; `device`: the operating system refused to read or write.
  explicit ToolError(std::string message, Kind kind = Kind::bad_input)
      : std::runtime_error(without_zeros(message)), kind_(kind) {}

  explicit ToolError(const Failure& failure) : ToolError(failure.message, failure.kind) {}

  [[nodiscard]] Kind kind() const { return kind_; }

  /// What the command line returns.
  [[nodiscard]] int exit_code() const { return kind_ == Kind::device ? kDeviceFailure : kBadInput; }

 private:
  /// Content that a message cites may have bytes of 0, at which what() would end.
  static const std::string& without_zeros(std::string& message) {
    std::ranges::replace(message, '\0', ' ');
    return message;
  }

  Kind kind_;
};

}  // namespace bladefit
