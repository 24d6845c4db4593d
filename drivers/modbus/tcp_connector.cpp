#include "drivers/modbus/tcp_connector.hpp"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "drivers/source/wait_ready.hpp"

namespace bladefit {
namespace {

std::string connect_error_text(int error) {
  switch (error) {
    case ECONNREFUSED:
      return "connection refused; switch on the machine's Modbus server or correct the port";
    case EHOSTUNREACH:
    case ENETUNREACH:
      return "the host cannot be reached; check the cable and the address";
    default:
      return fmt::format("{}; check the cable and the address", std::strerror(error));
  }
}

}  // namespace

Failure TcpConnector::resolve(const TcpSettings& settings) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  const int code = ::getaddrinfo(settings.host.c_str(), std::to_string(settings.port).c_str(), &hints, &list);
  if (code != 0)
    return device_failure(fmt::format("the host is not known ({}); correct its name or address", ::gai_strerror(code)));
  addresses_.clear();
  for (const addrinfo* entry = list; entry != nullptr; entry = entry->ai_next) {
    Address address;
    address.length = entry->ai_addrlen;
    std::memcpy(&address.storage, entry->ai_addr, entry->ai_addrlen);
    addresses_.push_back(address);
  }
  ::freeaddrinfo(list);
  return {};
}

void TcpConnector::start(Clock::time_point deadline) {
  stop();
  next_ = 0;
  deadline_ = deadline;
  fault_.clear();
  try_next();
}

/// Leaves socket_ at -1 where no address is left.
void TcpConnector::try_next() {
  while (next_ < addresses_.size()) {
    const Address& address = addresses_[next_++];
    socket_ = ::socket(address.storage.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (socket_ < 0) {
      fault_ = connect_error_text(errno);
      continue;
    }
    const int on = 1;
    ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address.storage), address.length) == 0) return;
    if (errno == EINPROGRESS) return;
    fault_ = connect_error_text(errno);
    stop();
  }
}

TcpConnector::Progress TcpConnector::advance(Clock::time_point until) {
  while (socket_ >= 0) {
    if (wait_ready(socket_, true, std::min(until, deadline_)) == Readiness::timeout) {
      if (Clock::now() < deadline_) return Progress::pending;
      fault_ = "no connection in time; check the cable and the address";
      stop();
      return Progress::failed;
    }
    int error = 0;
    socklen_t length = sizeof error;
    ::getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &length);
    if (error == 0) return Progress::connected;
    fault_ = connect_error_text(error);
    stop();
    try_next();
  }
  return Progress::failed;
}

int TcpConnector::release() {
  const int connected = socket_;
  socket_ = -1;
  return connected;
}

void TcpConnector::stop() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

}  // namespace bladefit
