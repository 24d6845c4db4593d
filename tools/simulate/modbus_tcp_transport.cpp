#include "tools/simulate/modbus_tcp_transport.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

#include "tools/files/tool_error.hpp"

namespace bladefit::simulate {
namespace {

constexpr const char* kLoopback = "127.0.0.1";
constexpr std::size_t kMostReaders = 16;

int bound_port(int listener) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  if (getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  return ntohs(address.sin_port);
}

}  // namespace

ModbusTcpTransport::ModbusTcpTransport(Machine& machine, int port, std::uint16_t map_version,
                                       const FaultSettings& faults, const Log& log)
    : log_(log) {
  ModbusContext context(modbus_new_tcp(kLoopback, port));
  if (!context) throw ToolError(fmt::format("--port {}: {}", port, modbus_strerror(errno)), ToolError::Kind::device);
  listener_ = Descriptor(modbus_tcp_listen(context.get(), static_cast<int>(kMostReaders)));
  if (!listener_) {
    throw ToolError(fmt::format("--port {}: cannot listen on {}: {}; give another port, or 0 for any free one", port,
                                kLoopback, std::strerror(errno)),
                    ToolError::Kind::device);
  }
  port_ = bound_port(listener_.get());
  responder_.emplace(std::move(context), machine, map_version, faults, true, log);
}

std::string ModbusTcpTransport::address() const { return fmt::format("over Modbus TCP on {}:{}", kLoopback, port_); }

std::vector<pollfd> ModbusTcpTransport::interests() const {
  std::vector<pollfd> interests;
  if (readers_.size() < kMostReaders) interests.push_back({listener_.get(), POLLIN, 0});
  for (const Reader& reader : readers_) interests.push_back({reader.socket.get(), POLLIN, 0});
  return interests;
}

std::optional<Clock::time_point> ModbusTcpTransport::next_wakeup() const {
  std::optional<Clock::time_point> earliest;
  for (const Reader& reader : readers_) {
    for (const LateAnswer& late : reader.late) {
      if (!earliest || late.due < *earliest) earliest = late.due;
    }
  }
  return earliest;
}

void ModbusTcpTransport::publish(Clock::time_point) { responder_->publish(); }

void ModbusTcpTransport::service(std::span<const pollfd> events, Clock::time_point now) {
  for (Reader& reader : readers_) {
    if (events_of(events, reader.socket.get()) != 0) answer_request(reader, now);
    send_late(reader, now);
  }
  const std::size_t before = readers_.size();
  readers_.remove_if([](const Reader& reader) { return reader.gone; });
  if (readers_.size() != before) log_("{} reader(s) left", readers_.size());
  if (events_of(events, listener_.get()) != 0) accept_reader();
}

void ModbusTcpTransport::accept_reader() {
  Descriptor socket(accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!socket) return;
  const int no_delay = 1;
  setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &no_delay, sizeof no_delay);
  readers_.push_back({std::move(socket), {}, false});
  log_("reader {} connected", readers_.size());
}

void ModbusTcpTransport::answer_request(Reader& reader, Clock::time_point now) {
  ModbusAnswer answer = responder_->receive(reader.socket.get(), now);
  reader.gone = answer.hang_up;
  if (answer.bytes.empty() || reader.gone) return;
  if (answer.delay.count() > 0) {
    reader.late.push_back({now + answer.delay, std::move(answer.bytes)});
    return;
  }
  send(reader, answer.bytes);
  if (answer.twice) send(reader, answer.bytes);
}

void ModbusTcpTransport::send_late(Reader& reader, Clock::time_point now) {
  for (const LateAnswer& late : reader.late) {
    if (late.due <= now) send(reader, late.bytes);
  }
  std::erase_if(reader.late, [now](const LateAnswer& late) { return late.due <= now; });
}

void ModbusTcpTransport::send(Reader& reader, const std::string& bytes) const {
  const ssize_t sent = ::send(reader.socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  // A reader that asks and asks but does not take its answers is not waited for.
  if (sent != static_cast<ssize_t>(bytes.size())) reader.gone = true;
}

}  // namespace bladefit::simulate
