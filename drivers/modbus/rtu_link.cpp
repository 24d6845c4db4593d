#include "drivers/modbus/rtu_link.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "drivers/modbus/cmm_header.hpp"
#include "drivers/serial/line_speed.hpp"
#include "drivers/source/crc16.hpp"
#include "drivers/source/wait_ready.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kRequestSize = 8;   ///< bytes of a read request
constexpr std::size_t kEnvelopeSize = 3;  ///< unit and CRC
constexpr int kLargestUnit = 247;
constexpr std::size_t kDrainLimit = std::size_t{1} << 16U;
constexpr std::chrono::microseconds kLeastPause{1750};  ///< between frames at 19200 baud and more

char parity_letter(Parity parity) {
  switch (parity) {
    case Parity::none:
      return 'N';
    case Parity::even:
      return 'E';
    case Parity::odd:
      break;
  }
  return 'O';
}

/// 3.5 characters, the least pause between two frames.
std::chrono::microseconds frame_pause(const SerialLineSettings& line) {
  return std::max(kLeastPause, wire_time(7, line) / 2);
}

}  // namespace

std::chrono::microseconds wire_time(std::size_t bytes, const SerialLineSettings& line) {
  const int bits = 1 + line.data_bits + (line.parity == Parity::none ? 0 : 1) + line.stop_bits;
  return std::chrono::microseconds(static_cast<std::int64_t>(bytes) * bits * 1'000'000 / line.baud + 1);
}

Failure RtuLink::prepare() {
  if (!speed_code(settings_.line.baud)) {
    return bad_input(
        fmt::format("{} baud is not a standard rate; set baud to one such as 9600 or 115200", settings_.line.baud));
  }
  const ModbusSettings& modbus = settings_;
  if (modbus.unit < 1 || modbus.unit > kLargestUnit) {
    return bad_input(
        fmt::format("unit {} is not an address on a serial line; set unit to 1..{}", modbus.unit, kLargestUnit));
  }
  ModbusRequest longest;
  const int records = modbus.batch * modbus.map.record_size;
  longest.count = static_cast<std::uint16_t>(
      std::min(std::max<int>(header_block(modbus.map).count, records), MODBUS_MAX_READ_REGISTERS));
  const auto least = wire_time(kRequestSize + reply_size(longest) + kEnvelopeSize, settings_.line);
  if (modbus.reply_timeout >= least) return {};
  const auto least_ms = std::chrono::ceil<std::chrono::milliseconds>(least).count();
  return bad_input(
      fmt::format("a reply timeout of {} ms is too short: request and reply take {} ms at {} baud; set "
                  "reply_timeout_ms to {} or more, or batch to fewer records",
                  modbus.reply_timeout.count(), least_ms, settings_.line.baud, 2 * least_ms));
}

LinkEvent RtuLink::connect(Clock::time_point) {
  close();
  if (Failure failure = guard_.lock(settings_.line.device)) return broken(std::move(failure.message));
  const SerialLineSettings& line = settings_.line;
  context_.reset(
      modbus_new_rtu(line.device.c_str(), line.baud, parity_letter(line.parity), line.data_bits, line.stop_bits));
  if (!context_) return broken(fmt::format("{}; correct the settings of the line", modbus_strerror(errno)));
  modbus_set_slave(context_.get(), settings_.unit);
  if (modbus_connect(context_.get()) != 0) return broken(port_error_text(errno));
  guard_.shut_out_others();
  remark_ = line.low_latency ? guard_.ask_low_latency() : std::string{};
  ready_at_ = Clock::now() + frame_pause(line);
  return LinkEvent::done;
}

/// Throws away what came before a request: late replies, noise.
LinkEvent RtuLink::drain() {
  const int port = modbus_get_socket(context_.get());
  std::array<std::uint8_t, 1024> waste{};
  for (std::size_t total = 0; total < kDrainLimit;) {
    const Readiness readiness = wait_ready(port, false, Clock::time_point{});
    if (readiness == Readiness::timeout) return LinkEvent::done;
    if (readiness == Readiness::hang_up) return broken("the port has hung up; check the cable");
    const ssize_t count = ::read(port, waste.data(), waste.size());
    if (count == 0) return broken("the port has hung up; check the cable");
    if (count < 0) return broken(port_error_text(errno));
    total += static_cast<std::size_t>(count);
  }
  return LinkEvent::done;
}

LinkEvent RtuLink::send(const ModbusRequest& request) {
  request_ = request;
  other_unit_.reset();
  if (const LinkEvent event = drain(); event != LinkEvent::done) return event;
  const ModbusPdu pdu = encode_request(request);
  sent_[0] = static_cast<std::uint8_t>(settings_.unit);
  std::copy(pdu.view().begin(), pdu.view().end(), sent_.begin() + 1);
  const auto size = static_cast<int>(pdu.size + 1);
  const int sent = modbus_send_raw_request(context_.get(), sent_.data(), size);
  deadline_ = Clock::now() + settings_.reply_timeout;
  if (sent < 0) return broken(port_error_text(errno));
  if (sent != size + 2) return broken("the port takes no more bytes; check the cable");
  const std::uint16_t crc = crc16({reinterpret_cast<const char*>(sent_.data()), pdu.size + 1});
  sent_[pdu.size + 1] = static_cast<std::uint8_t>(crc & 0xFFU);
  sent_[pdu.size + 2] = static_cast<std::uint8_t>(crc >> 8U);
  sent_size_ = pdu.size + 3;
  echo_size_ = settings_.echo ? sent_size_ : 0;
  return LinkEvent::done;
}

/// Takes the bytes that an RS-485 adapter hears of its own sending. Called when the port can be read.
LinkEvent RtuLink::read_echo() {
  std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> heard{};
  const ssize_t count = ::read(modbus_get_socket(context_.get()), heard.data(), echo_size_);
  if (count == 0) return broken("the port has hung up; check the cable");
  if (count < 0) return broken(port_error_text(errno));
  const auto size = static_cast<std::size_t>(count);
  const auto* expected = sent_.data() + (sent_size_ - echo_size_);
  if (!std::equal(heard.data(), heard.data() + size, expected)) {
    fault_ = "the echo differs from what was sent; set echo = false or check the RS-485 wiring";
    return quiet_after(LinkEvent::damaged);
  }
  echo_size_ -= size;
  return LinkEvent::pending;
}

LinkEvent RtuLink::quiet_after(LinkEvent event) {
  ready_at_ = Clock::now() +
              (event == LinkEvent::done ? frame_pause(settings_.line) : std::chrono::microseconds(settings_.quiet));
  return event;
}

LinkEvent RtuLink::receive(std::span<std::uint16_t> registers, Clock::time_point until) {
  while (true) {
    const Readiness readiness = wait_ready(modbus_get_socket(context_.get()), false, std::min(until, deadline_));
    if (readiness == Readiness::hang_up) return broken("the port has hung up; check the cable");
    if (readiness == Readiness::timeout && Clock::now() < deadline_) return LinkEvent::pending;
    if (readiness == Readiness::timeout) return quiet_after(timed_out(settings_.unit, settings_.reply_timeout));
    if (echo_size_ > 0) {
      if (const LinkEvent event = read_echo(); event != LinkEvent::pending) return event;
      continue;
    }
    std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> frame{};
    LinkEvent event = LinkEvent::done;
    const std::size_t size = receive_frame(frame, event);
    if (event == LinkEvent::broken) return event;
    if (event != LinkEvent::done) return quiet_after(event);
    // libmodbus returns 0 for a frame of another unit: it is skipped and waiting goes on.
    if (frame[0] != settings_.unit) other_unit_ = frame[0];
    if (size <= kEnvelopeSize || frame[0] != settings_.unit) continue;
    const std::span<const std::uint8_t> pdu(frame.data() + 1, size - kEnvelopeSize);
    switch (match_reply(pdu, request_, registers, fault_)) {
      case ReplyKind::good:
        return quiet_after(LinkEvent::done);
      case ReplyKind::refused:
        static_cast<void>(quiet_after(LinkEvent::done));
        return LinkEvent::refused;
      case ReplyKind::absent:
        static_cast<void>(quiet_after(LinkEvent::done));
        return LinkEvent::absent;
      case ReplyKind::unknown:
        static_cast<void>(quiet_after(LinkEvent::done));
        return LinkEvent::unknown;
      case ReplyKind::busy:
        static_cast<void>(quiet_after(LinkEvent::done));
        return LinkEvent::busy;
      case ReplyKind::foreign:
        break;
    }
  }
}

void RtuLink::close() {
  if (context_) {
    modbus_close(context_.get());
    context_.reset();
  }
  guard_.release();
  echo_size_ = 0;
}

}  // namespace bladefit
