#pragma once
#include <poll.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/simulate/machine.hpp"

namespace bladefit::simulate {

/// One way in which readers reach the machine. The loop of run_simulator() owns it and calls it from one thread.
class Transport {
 public:
  virtual ~Transport() = default;

  /// For the line that says it is ready, for example "over Modbus TCP on 127.0.0.1:1502".
  [[nodiscard]] virtual std::string address() const = 0;

  /// Descriptors whose events wake the loop.
  [[nodiscard]] virtual std::vector<pollfd> interests() const = 0;

  /// When service() must be called even if nothing happens on a descriptor.
  [[nodiscard]] virtual std::optional<Clock::time_point> next_wakeup() const = 0;

  /// Makes new records of the machine readable.
  virtual void publish(Clock::time_point now) = 0;

  /// Answers what has come in; `events` is interests() after poll(). Never waits for a reader.
  virtual void service(std::span<const pollfd> events, Clock::time_point now) = 0;

  /// True while a reader is connected.
  [[nodiscard]] virtual bool has_reader() const = 0;
};

/// What poll() reported for a descriptor; 0 if it was not waited for.
[[nodiscard]] inline short events_of(std::span<const pollfd> events, int descriptor) {
  for (const pollfd& event : events) {
    if (event.fd == descriptor) return event.revents;
  }
  return 0;
}

}  // namespace bladefit::simulate
