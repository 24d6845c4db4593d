#pragma once
#include "drivers/modbus/modbus_link.hpp"
#include "drivers/serial/port_guard.hpp"

namespace bladefit {

/// Modbus RTU. A reply does not say which request it answers, so after a missing one the line is left quiet for a while
/// and drained, and frames that do not fit the request are skipped.
class RtuLink final : public ModbusLink {
 public:
  explicit RtuLink(const ModbusSettings& settings) : settings_(settings) {}
  ~RtuLink() override { close(); }

  [[nodiscard]] Failure prepare() override;
  void start_connect() override {}
  [[nodiscard]] LinkEvent connect(Clock::time_point until) override;
  [[nodiscard]] bool is_open() const override { return context_ != nullptr; }
  [[nodiscard]] LinkEvent send(const ModbusRequest& request) override;
  [[nodiscard]] LinkEvent receive(std::span<std::uint16_t> registers, Clock::time_point until) override;
  void close() override;

 private:
  [[nodiscard]] LinkEvent drain();
  [[nodiscard]] LinkEvent read_echo();
  [[nodiscard]] LinkEvent quiet_after(LinkEvent event);

  const ModbusSettings settings_;
  PortGuard guard_;
  std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> sent_{};
  std::size_t echo_size_ = 0;  ///< bytes of the echo still to come
  std::size_t sent_size_ = 0;
};

/// Time that `bytes` take on a serial line.
[[nodiscard]] std::chrono::microseconds wire_time(std::size_t bytes, const SerialLineSettings& line);

}  // namespace bladefit
