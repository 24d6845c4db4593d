#include "tools/panel/panel_client.hpp"

#include <fmt/format.h>
#include <modbus.h>

#include <array>
#include <cerrno>

namespace bladefit {
namespace {

constexpr std::uint32_t kReplyTimeout_us = 500'000;
constexpr int kUnit = 1;

}  // namespace

void PanelClient::Closer::operator()(_modbus* context) const {
  modbus_close(context);
  modbus_free(context);
}

std::string PanelClient::address() const { return fmt::format("{}:{}", host_, port_); }

Failure PanelClient::connect() {
  context_.reset(modbus_new_tcp_pi(host_.c_str(), std::to_string(port_).c_str()));
  if (!context_)
    return device_failure(fmt::format("{}: is no address; use HOST:PORT, for example 127.0.0.1:1503", address()));
  modbus_set_response_timeout(context_.get(), 0, kReplyTimeout_us);
  if (modbus_set_slave(context_.get(), kUnit) == 0 && modbus_connect(context_.get()) == 0) return {};
  const int reason = errno;
  context_.reset();
  return device_failure(
      fmt::format("{}: no panel answers there ({}); start `bladefit run`, or name its --panel with --connect",
                  address(), modbus_strerror(reason)));
}

Failure PanelClient::read(PanelState& state) {
  if (!context_) {
    if (Failure error = connect()) return error;
  }
  std::array<std::uint16_t, kPanelRegisters> registers{};
  if (modbus_read_input_registers(context_.get(), 0, kPanelRegisters, registers.data()) != kPanelRegisters) {
    const int reason = errno;
    context_.reset();
    return device_failure(fmt::format("{}: the panel does not answer ({}); check that it is a bladefit panel",
                                      address(), modbus_strerror(reason)));
  }
  std::array<std::uint16_t, kExtensionRegisters> extension{};
  const bool extended = modbus_read_input_registers(context_.get(), kExtensionBase, static_cast<int>(extension.size()),
                                                    extension.data()) == static_cast<int>(extension.size());
  const std::span<const std::uint16_t> known =
      extended ? std::span<const std::uint16_t>(extension) : std::span<const std::uint16_t>();
  if (decode_panel(registers, known, state)) return {};
  context_.reset();
  return device_failure(
      fmt::format("{}: panel map of version {}, this program reads version {}; use the bladefit of that host",
                  address(), registers[0], kPanelMapVersion));
}

}  // namespace bladefit
