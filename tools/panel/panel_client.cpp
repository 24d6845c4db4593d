#include "tools/panel/panel_client.hpp"

#include <fmt/format.h>
#include <modbus.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace bladefit {
namespace {

constexpr std::uint32_t kReplyTimeout_us = 500'000;
constexpr int kUnit = 1;
constexpr std::size_t kMostRegisters = 120;  ///< of a request

}  // namespace

void PanelClient::Closer::operator()(_modbus* context) const {
  modbus_close(context);
  modbus_free(context);
}

std::string PanelClient::address() const { return fmt::format("{}:{}", host_, port_); }

Failure PanelClient::connect() {
  context_.reset(modbus_new_tcp_pi(host_.c_str(), std::to_string(port_).c_str()));
  if (!context_)
    return device_failure(fmt::format("{}: is not an address; use HOST:PORT, for example 127.0.0.1:1503", address()));
  modbus_set_response_timeout(context_.get(), 0, kReplyTimeout_us);
  if (modbus_set_slave(context_.get(), kUnit) == 0 && modbus_connect(context_.get()) == 0) return {};
  const int reason = errno;
  context_.reset();
  return device_failure(
      fmt::format("{}: no panel answers there ({}); start `bladefit run`, or name its --panel with --connect",
                  address(), modbus_strerror(reason)));
}

std::span<const std::uint16_t> PanelClient::read_block(std::uint16_t first, std::span<std::uint16_t> registers) const {
  for (std::size_t done = 0; done < registers.size();) {
    const int count = static_cast<int>(std::min(kMostRegisters, registers.size() - done));
    const int address = first + static_cast<int>(done);
    if (modbus_read_input_registers(context_.get(), address, count, registers.data() + done) != count) return {};
    done += static_cast<std::size_t>(count);
  }
  return registers;
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
  std::array<std::uint16_t, kBladeRegisters> blade{};
  const auto known = read_block(kExtensionBase, extension);
  const auto told = known.empty() ? known : read_block(kBladeBase, blade);
  if (decode_panel(registers, known, told, state)) return {};
  context_.reset();
  return device_failure(
      fmt::format("{}: panel map of version {}, this program reads version {}; use the bladefit of that host",
                  address(), registers[0], kPanelMapVersion));
}

}  // namespace bladefit
