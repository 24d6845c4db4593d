#pragma once
#include "drivers/serial/serial_port.hpp"
#include "drivers/source/back_off.hpp"
#include "drivers/source/probe_source.hpp"

namespace bladefit {

/// A serial port that is opened again after it was lost, with growing pauses between the tries.
class LastingPort {
 public:
  using Clock = std::chrono::steady_clock;

  LastingPort(const SerialLineSettings& line, std::chrono::milliseconds first, std::chrono::milliseconds longest)
      : line_(line), back_off_(first, longest) {}

  /// Opens it for the first time. `device`: a phrase with the fix.
  [[nodiscard]] Failure open() { return port_.open(line_); }

  /// Closes it because of a fault, which is published.
  void lost(const std::string& fault, SourceStatus& status);

  /// Tries to open it again, or waits until the next try is due, until `until` at the latest. True when it is open.
  [[nodiscard]] bool reopen(Clock::time_point until, SourceStatus& status);

  [[nodiscard]] SerialPort* operator->() { return &port_; }

 private:
  const SerialLineSettings line_;
  SerialPort port_;
  BackOff back_off_;
};

}  // namespace bladefit
