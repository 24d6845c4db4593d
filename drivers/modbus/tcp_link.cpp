#include "drivers/modbus/tcp_link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "drivers/source/wait_ready.hpp"

namespace bladefit {

void TcpLink::start_connect() {
  close();
  connector_.start(Clock::now() + settings_.connect_timeout);
}

LinkEvent TcpLink::connect(Clock::time_point until) {
  switch (connector_.advance(until)) {
    case TcpConnector::Progress::pending:
      return LinkEvent::pending;
    case TcpConnector::Progress::failed:
      return broken(connector_.fault());
    case TcpConnector::Progress::connected:
      break;
  }
  const int connected = connector_.release();
  // The address is not used: the context gets a socket that is connected already.
  context_.reset(modbus_new_tcp("127.0.0.1", settings_.tcp.port));
  modbus_set_socket(context_.get(), connected);
  ready_at_ = Clock::now();
  return LinkEvent::done;
}

LinkEvent TcpLink::send(const ModbusRequest& request) {
  request_ = request;
  other_unit_.reset();
  ++transaction_;
  const ModbusPdu pdu = encode_request(request);
  const auto header = tcp_header(transaction_, static_cast<std::uint8_t>(settings_.unit), pdu.size);
  std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> frame{};
  std::copy(header.begin(), header.end(), frame.begin());
  std::copy(pdu.view().begin(), pdu.view().end(), frame.begin() + kTcpHeaderSize);
  const std::size_t size = kTcpHeaderSize + pdu.size;
  const ssize_t sent = ::send(modbus_get_socket(context_.get()), frame.data(), size, MSG_NOSIGNAL | MSG_DONTWAIT);
  deadline_ = Clock::now() + settings_.reply_timeout;
  if (sent == static_cast<ssize_t>(size)) return LinkEvent::done;
  return broken(sent < 0 ? std::strerror(errno) : "the device takes no more bytes");
}

LinkEvent TcpLink::receive(std::span<std::uint16_t> registers, Clock::time_point until) {
  while (true) {
    const Readiness readiness = wait_ready(modbus_get_socket(context_.get()), false, std::min(until, deadline_));
    if (readiness == Readiness::hang_up) return broken("the device has closed the connection");
    if (readiness == Readiness::timeout && Clock::now() < deadline_) return LinkEvent::pending;
    if (readiness == Readiness::timeout) return timed_out(settings_.unit, settings_.reply_timeout);
    std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> frame{};
    LinkEvent event = LinkEvent::done;
    const std::size_t size = receive_frame(frame, event);
    if (event == LinkEvent::broken) return event;
    // A part of a frame, or a length that contradicts itself, leaves the stream without a place to go on reading.
    if (event != LinkEvent::done) return broken(fmt::format("half a reply: {}", fault_));
    const std::size_t given = static_cast<std::size_t>((frame[4] << 8U) | frame[5]) + kTcpHeaderSize - 1;
    if (size <= kTcpHeaderSize || given != size || frame[2] != 0 || frame[3] != 0)
      return broken("a reply of a wrong length");
    const auto transaction = static_cast<std::uint16_t>((frame[0] << 8U) | frame[1]);
    if (transaction == transaction_ && frame[6] != settings_.unit) other_unit_ = frame[6];
    if (transaction != transaction_ || frame[6] != settings_.unit) continue;
    const std::span<const std::uint8_t> pdu(frame.data() + kTcpHeaderSize, size - kTcpHeaderSize);
    switch (match_reply(pdu, request_, registers, fault_)) {
      case ReplyKind::good:
        return LinkEvent::done;
      case ReplyKind::refused:
        return LinkEvent::refused;
      case ReplyKind::unknown:
        return LinkEvent::unknown;
      case ReplyKind::absent:
        return LinkEvent::absent;
      case ReplyKind::busy:
        return LinkEvent::busy;
      case ReplyKind::foreign:
        return broken("a reply that does not fit its request");
    }
  }
}

void TcpLink::close() {
  connector_.stop();
  if (!context_) return;
  modbus_close(context_.get());
  context_.reset();
}

}  // namespace bladefit
