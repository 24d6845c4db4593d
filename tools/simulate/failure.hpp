#pragma once
#include <stdexcept>
#include <string>

namespace bladefit::simulate {

inline constexpr int kExitDone = 0;
inline constexpr int kExitBadInput = 2;
inline constexpr int kExitDevice = 3;

/// Ends the simulator. what() is one line that names the file, the option or the device and the fix.
class Failure : public std::runtime_error {
 public:
  Failure(int exit_code, const std::string& line) : std::runtime_error(line), exit_code_(exit_code) {}
  [[nodiscard]] int exit_code() const { return exit_code_; }

 private:
  int exit_code_;
};

}  // namespace bladefit::simulate
