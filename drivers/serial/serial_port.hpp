#pragma once
#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "drivers/serial/line_settings.hpp"
#include "drivers/serial/port_guard.hpp"

namespace bladefit {

/// An open serial port of which this process is the only user. Nothing here blocks longer than it is told to.
/// It speaks to the system itself, because libserialport opens no pseudo terminals and goes on reading after a hang-up.
class SerialPort {
 public:
  using Clock = std::chrono::steady_clock;

  SerialPort() = default;
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;
  ~SerialPort() { close(); }

  /// Opens and sets the port and throws away what was waiting in it. `device`: a phrase with the fix.
  [[nodiscard]] Failure open(const SerialLineSettings& settings);

  [[nodiscard]] bool is_open() const { return guard_.descriptor() >= 0; }

  /// Waits for bytes until `until` and takes them. Returns how many, 0 = none came; nothing where the port has hung up.
  [[nodiscard]] std::optional<std::size_t> read(std::span<char> bytes, Clock::time_point until);

  /// Writes what the port takes at once. Returns how many bytes; nothing where the port has hung up.
  [[nodiscard]] std::optional<std::size_t> write(std::string_view bytes);

  /// Waits until everything written has left the port, until `until` at the latest.
  void drain(Clock::time_point until);

  void close() { guard_.release(); }

  /// Something the user should know of the open port; empty = nothing.
  [[nodiscard]] const std::string& remark() const { return remark_; }

 private:
  PortGuard guard_;
  std::string remark_;
};

}  // namespace bladefit
