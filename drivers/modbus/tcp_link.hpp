#pragma once
#include "drivers/modbus/modbus_link.hpp"
#include "drivers/modbus/tcp_connector.hpp"

namespace bladefit {

/// Modbus TCP. Every reply carries the number of its transaction, so that late ones are told apart and skipped.
class TcpLink final : public ModbusLink {
 public:
  explicit TcpLink(const ModbusSettings& settings) : settings_(settings) {}
  ~TcpLink() override { close(); }

  [[nodiscard]] Failure prepare() override { return connector_.resolve(settings_.tcp); }
  void start_connect() override;
  [[nodiscard]] LinkEvent connect(Clock::time_point until) override;
  [[nodiscard]] bool is_open() const override { return context_ != nullptr; }
  [[nodiscard]] LinkEvent send(const ModbusRequest& request) override;
  [[nodiscard]] LinkEvent receive(std::span<std::uint16_t> registers, Clock::time_point until) override;
  void close() override;

 private:
  const ModbusSettings settings_;
  TcpConnector connector_;
  std::uint16_t transaction_ = 0;
};

}  // namespace bladefit
