#include "drivers/serial/serial_port.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <thread>

#include "drivers/wait_ready.hpp"

namespace bladefit {
namespace {

sp_parity parity_of(Parity parity) {
  switch (parity) {
    case Parity::none:
      return SP_PARITY_NONE;
    case Parity::even:
      return SP_PARITY_EVEN;
    case Parity::odd:
      break;
  }
  return SP_PARITY_ODD;
}

/// Sets every property of the line. Returns a phrase with the mend; empty = set.
std::string configure(sp_port* port, const SerialLineSettings& settings) {
  const bool set = sp_set_baudrate(port, settings.baud) == SP_OK && sp_set_bits(port, settings.data_bits) == SP_OK &&
                   sp_set_parity(port, parity_of(settings.parity)) == SP_OK &&
                   sp_set_stopbits(port, settings.stop_bits) == SP_OK &&
                   sp_set_flowcontrol(port, SP_FLOWCONTROL_NONE) == SP_OK;
  if (set) return {};
  return fmt::format("the port cannot be set to {} baud, {} data bits, {} stop bits; correct the settings of the line",
                     settings.baud, settings.data_bits, settings.stop_bits);
}

}  // namespace

std::string SerialPort::open(const SerialLineSettings& settings) {
  close();
  if (std::string fault = guard_.lock(settings.device); !fault.empty()) return fault;
  std::string fault;
  // libserialport knows ports by their names below /dev only, and a by-id path is a link.
  std::error_code missing;
  const std::filesystem::path real = std::filesystem::canonical(settings.device, missing);
  if (missing || sp_get_port_by_name(real.c_str(), &port_) != SP_OK) {
    port_ = nullptr;
    fault = "this is no serial port; correct the path";
  } else if (sp_open(port_, SP_MODE_READ_WRITE) != SP_OK) {
    fault = port_error_text(sp_last_error_code());
    sp_free_port(port_);
    port_ = nullptr;
  } else {
    fault = configure(port_, settings);
  }
  if (!fault.empty()) {
    close();
    return fault;
  }
  sp_flush(port_, SP_BUF_BOTH);
  sp_get_port_handle(port_, &descriptor_);
  guard_.shut_out_others();
  remark_ = settings.low_latency ? guard_.ask_low_latency() : std::string{};
  return {};
}

std::optional<std::size_t> SerialPort::read(std::span<char> bytes, Clock::time_point until) {
  const Readiness readiness = wait_ready(descriptor_, false, until);
  if (readiness == Readiness::hang_up) return std::nullopt;
  if (readiness == Readiness::timeout) return std::size_t{0};
  const int count = sp_nonblocking_read(port_, bytes.data(), bytes.size());
  // Nothing in a port that could be read means that the other end is gone.
  if (count <= 0) return std::nullopt;
  return static_cast<std::size_t>(count);
}

std::optional<std::size_t> SerialPort::write(std::string_view bytes) {
  const int count = sp_nonblocking_write(port_, bytes.data(), bytes.size());
  if (count < 0) return std::nullopt;
  return static_cast<std::size_t>(count);
}

void SerialPort::drain(Clock::time_point until) {
  while (port_ != nullptr && sp_output_waiting(port_) > 0 && Clock::now() < until) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void SerialPort::close() {
  if (port_ != nullptr) {
    // Closing a port whose device is gone may fail; what matters is that it can be opened again.
    sp_close(port_);
    sp_free_port(port_);
  }
  port_ = nullptr;
  descriptor_ = -1;
  guard_.release();
}

}  // namespace bladefit
