#include "tools/web/client_stream.hpp"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>

namespace bladefit {
namespace {

using NameOf = int (*)(int, sockaddr*, socklen_t*);

void name_socket(int descriptor, NameOf name_of, std::string& ip, int& port) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> service{};
  auto* const plain = reinterpret_cast<sockaddr*>(&address);
  if (name_of(descriptor, plain, &size) != 0) return;
  const int flags = NI_NUMERICHOST | NI_NUMERICSERV;
  if (getnameinfo(plain, size, host.data(), host.size(), service.data(), service.size(), flags) != 0) return;
  constexpr std::string_view kMapped = "::ffff:";
  const std::string_view name = host.data();
  ip = name.starts_with(kMapped) ? name.substr(kMapped.size()) : name;
  std::from_chars(service.data(), service.data() + std::strlen(service.data()), port);
}

/// True when the socket is ready before the deadline.
bool is_ready(int descriptor, short events, std::chrono::steady_clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
  if (left.count() <= 0) return false;
  pollfd watched{descriptor, events, 0};
  return poll(&watched, 1, static_cast<int>(left.count())) > 0 && (watched.revents & events) != 0;
}

}  // namespace

ClientStream::ClientStream(int descriptor) : descriptor_(descriptor) {
  fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK);
}

ClientStream::~ClientStream() {
  shutdown(descriptor_, SHUT_RDWR);
  close(descriptor_);
}

bool ClientStream::is_readable() const { return used_ < filled_ || is_ready(descriptor_, POLLIN, deadline_); }

bool ClientStream::is_writable() const {
  // One that is slow is waited for by write().
  pollfd watched{descriptor_, POLLRDHUP, 0};
  return poll(&watched, 1, 0) == 0;
}

ssize_t ClientStream::read(char* to, std::size_t size) {
  while (used_ == filled_) {
    if (!is_ready(descriptor_, POLLIN, deadline_)) return -1;
    const ssize_t count = recv(descriptor_, buffer_.data(), buffer_.size(), 0);
    if (count == 0) return 0;
    if (count < 0 && errno != EAGAIN && errno != EINTR) return -1;
    used_ = 0;
    filled_ = static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
  const std::size_t count = std::min(size, filled_ - used_);
  std::memcpy(to, buffer_.data() + used_, count);
  used_ += count;
  return static_cast<ssize_t>(count);
}

ssize_t ClientStream::write(const char* from, std::size_t size) {
  const Clock::time_point deadline = Clock::now() + kAnswerTime;
  std::size_t sent = 0;
  while (sent < size) {
    const ssize_t count = send(descriptor_, from + sent, size - sent, MSG_NOSIGNAL);
    if (count > 0) sent += static_cast<std::size_t>(count);
    if (count < 0 && errno != EAGAIN && errno != EINTR) return -1;
    if (count <= 0 && !is_ready(descriptor_, POLLOUT, deadline)) return -1;
  }
  return static_cast<ssize_t>(size);
}

void ClientStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  name_socket(descriptor_, getpeername, ip, port);
}

void ClientStream::get_local_ip_and_port(std::string& ip, int& port) const {
  name_socket(descriptor_, getsockname, ip, port);
}

}  // namespace bladefit
