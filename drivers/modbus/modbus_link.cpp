#include "drivers/modbus/modbus_link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <thread>

#include "drivers/modbus/rtu_link.hpp"
#include "drivers/modbus/tcp_link.hpp"

namespace bladefit {

bool ModbusLink::exchange(const ModbusRequest& request, std::span<std::uint16_t> registers, Clock::time_point until) {
  std::this_thread::sleep_until(std::min(until, ready_at_));
  return send(request) == LinkEvent::done && receive(registers, until) == LinkEvent::done;
}

std::size_t ModbusLink::receive_frame(std::span<std::uint8_t, MODBUS_MAX_ADU_LENGTH> frame, LinkEvent& event) {
  constexpr std::int64_t kLeastTimeoutUs = 1000;
  const auto left = std::chrono::duration_cast<std::chrono::microseconds>(deadline_ - Clock::now()).count();
  const std::int64_t timeout_us = std::max<std::int64_t>(left, kLeastTimeoutUs);
  modbus_set_response_timeout(context_.get(), static_cast<std::uint32_t>(timeout_us / 1'000'000),
                              static_cast<std::uint32_t>(timeout_us % 1'000'000));
  // Without a byte timeout libmodbus takes the response timeout for the whole frame.
  modbus_set_byte_timeout(context_.get(), 0, 0);
  const int size = modbus_receive_confirmation(context_.get(), frame.data());
  if (size >= 0) {
    event = LinkEvent::done;
    return static_cast<std::size_t>(size);
  }
  const int error = errno;
  fault_ = modbus_strerror(error);
  if (error == ETIMEDOUT) {
    event = LinkEvent::timeout;
  } else if (error == EMBBADCRC || error == EMBBADDATA) {
    event = LinkEvent::damaged;
  } else {
    event = broken(fault_);
  }
  return 0;
}

LinkEvent ModbusLink::timed_out(int unit, std::chrono::milliseconds timeout) {
  fault_ = other_unit_ ? fmt::format("unit {0} answers in place of unit {1}; set unit = {0} in the device file",
                                     *other_unit_, unit)
                       : fmt::format("no reply from unit {} within {} ms", unit, timeout.count());
  return LinkEvent::timeout;
}

LinkEvent ModbusLink::broken(std::string fault) {
  close();
  fault_ = std::move(fault);
  return LinkEvent::broken;
}

std::unique_ptr<ModbusLink> make_modbus_link(const ModbusSettings& settings) {
  if (settings.transport == ModbusTransport::tcp) return std::make_unique<TcpLink>(settings);
  return std::make_unique<RtuLink>(settings);
}

}  // namespace bladefit
