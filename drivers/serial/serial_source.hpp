#pragma once
#include <string>

#include "drivers/serial/echo_filter.hpp"
#include "drivers/serial/lasting_port.hpp"
#include "drivers/serial/line_framer.hpp"
#include "drivers/serial/serial_session.hpp"
#include "drivers/source/probe_source.hpp"

namespace bladefit {

/// A machine that speaks serial protocol v1.
class SerialSource final : public ProbeSource {
 public:
  SerialSource(const SerialSettings& settings, std::string name);

  /// Takes at most about settings.open_timeout. A port that hangs up meanwhile is opened again.
  [[nodiscard]] Failure open(std::uint32_t after, std::uint32_t run_id) override;
  [[nodiscard]] std::size_t poll(std::span<ProbePoint> points, std::chrono::milliseconds timeout) override;
  void acknowledge(std::uint32_t sequence) override { session_.acknowledge(sequence); }
  void close() override;
  [[nodiscard]] const SourceStatus& status() const override { return status_; }

 private:
  using Clock = std::chrono::steady_clock;

  void step(Clock::time_point until);
  void reconnect(Clock::time_point until);
  void link_made();
  void link_lost(const std::string& fault);
  void send();
  void take_lines();

  const SerialSettings settings_;
  const std::string name_;
  SourceStatus status_;
  SerialSession session_;
  LastingPort port_;
  LineFramer framer_;
  EchoFilter echo_;
  std::string unsent_;
};

}  // namespace bladefit
