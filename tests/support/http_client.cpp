#include "tests/support/http_client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

namespace bladefit::testing {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kPatienceForAnswer{20};

/// True when something can be read, or the end is there.
bool has_news(int descriptor, Clock::time_point until) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
  pollfd watched{descriptor, POLLIN, 0};
  return left.count() > 0 && poll(&watched, 1, static_cast<int>(left.count())) > 0;
}

}  // namespace

HttpConnection::HttpConnection(std::uint16_t port) : descriptor_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return;
  ::close(descriptor_);
  throw std::runtime_error("nobody listens at port " + std::to_string(port));
}

HttpConnection::~HttpConnection() { ::close(descriptor_); }

void HttpConnection::send(const std::string& text) const {
  std::size_t sent = 0;
  while (sent < text.size()) {
    const ssize_t count = ::send(descriptor_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) return;  // the server has closed: what it answered tells why
    sent += static_cast<std::size_t>(count);
  }
}

const std::string& HttpConnection::receive(const std::string& end, std::chrono::milliseconds patience) {
  const Clock::time_point until = Clock::now() + patience;
  std::array<char, 65536> chunk;
  while (end.empty() || received_.find(end) == std::string::npos) {
    if (!has_news(descriptor_, until)) break;
    const ssize_t count = recv(descriptor_, chunk.data(), chunk.size(), 0);
    if (count <= 0) break;
    received_.append(chunk.data(), static_cast<std::size_t>(count));
  }
  return received_;
}

bool HttpConnection::closes(std::chrono::milliseconds patience) const {
  const Clock::time_point until = Clock::now() + patience;
  std::array<char, 4096> chunk;
  while (has_news(descriptor_, until)) {
    if (recv(descriptor_, chunk.data(), chunk.size(), 0) <= 0) return true;
  }
  return false;
}

HttpAnswer http_ask(std::uint16_t port, const std::string& method, const std::string& path, const std::string& body,
                    const std::string& headers, const std::string& host) {
  HttpConnection connection(port);
  const std::string name = host.empty() ? "127.0.0.1:" + std::to_string(port) : host;
  connection.send(method + " " + path + " HTTP/1.1\r\nHost: " + name +
                  "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" + headers + "\r\n" + body);
  const std::string text = connection.receive("", kPatienceForAnswer);
  const std::size_t end = text.find("\r\n\r\n");
  HttpAnswer answer;
  if (end == std::string::npos || !text.starts_with("HTTP/1.1 ")) return answer;
  constexpr std::size_t kVersion = 9;
  answer.status = std::atoi(text.c_str() + kVersion);
  answer.head = text.substr(0, end);
  answer.body = text.substr(end + 4);
  return answer;
}

}  // namespace bladefit::testing
