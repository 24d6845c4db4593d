#include "firmware_bridge/host/panel/panel_server.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace bladefit {
namespace {

// Header of Modbus TCP: transaction (2), protocol (2, always 0), length of what follows (2), unit (1).
constexpr std::size_t kHeaderSize = 7;
constexpr std::size_t kLengthOffset = 4;
constexpr std::size_t kUnitOffset = 6;
constexpr int kAnswersPerTurn = 8;
constexpr std::chrono::milliseconds kTurn{2};
constexpr std::chrono::seconds kAsksNowAndThen{2};
constexpr int kBacklog = 64;

std::string numeric_address(const sockaddr_storage& address, socklen_t size) {
  std::array<char, NI_MAXHOST> text{};
  if (getnameinfo(reinterpret_cast<const sockaddr*>(&address), size, text.data(), text.size(), nullptr, 0,
                  NI_NUMERICHOST) != 0) {
    return {};
  }
  constexpr std::string_view kMapped = "::ffff:";
  const std::string_view name = text.data();
  return std::string(name.starts_with(kMapped) ? name.substr(kMapped.size()) : name);
}

std::uint16_t port_of(int descriptor) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  // The port stands at the same place in both kinds of address.
  return ntohs(reinterpret_cast<const sockaddr_in*>(&address)->sin_port);
}

}  // namespace

PanelServer::~PanelServer() {
  for (const Client& client : clients_) close(client.descriptor);
  if (listener_ >= 0) close(listener_);
}

Failure PanelServer::open(const PanelServerSettings& settings) {
  settings_ = settings;
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  if (getaddrinfo(settings.host.c_str(), std::to_string(settings.port).c_str(), &hints, &found) != 0) {
    return bad_input(
        fmt::format("--panel {}:{}: no address of this name; use HOST:PORT, for example "
                    "127.0.0.1:1503",
                    settings.host, settings.port));
  }
  listener_ = socket(found->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int on = 1;
  const bool listening = listener_ >= 0 && setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
                         bind(listener_, found->ai_addr, found->ai_addrlen) == 0 && listen(listener_, kBacklog) == 0;
  const int reason = errno;
  freeaddrinfo(found);
  if (!listening) {
    return device_failure(
        fmt::format("--panel {}:{}: cannot listen there ({}); choose another address or port, "
                    "port 0 takes any free one",
                    settings.host, settings.port, std::strerror(reason)));
  }
  port_ = port_of(listener_);
  return {};
}

void PanelServer::wait(int wakeup_descriptor, std::chrono::milliseconds timeout) {
  pollfd wakeup{wakeup_descriptor, POLLIN, 0};
  const auto pause = std::chrono::ceil<std::chrono::milliseconds>(next_turn_ - Clock::now());
  if (pause.count() > 0 && poll(&wakeup, 1, static_cast<int>(pause.count())) != 0) return;
  std::array<pollfd, kMostClients + 2> watched{};
  watched[0] = {wakeup_descriptor, POLLIN, 0};
  watched[1] = {listener_, POLLIN, 0};
  for (std::size_t index = 0; index < clients_.size(); ++index) {
    // Who does not take its answers is not asked for further requests.
    watched[index + 2] = {clients_[index].descriptor,
                          static_cast<short>(clients_[index].unsent.empty() ? POLLIN : POLLOUT), 0};
  }
  if (poll(watched.data(), clients_.size() + 2, static_cast<int>(timeout.count())) <= 0) return;
  connection_waiting_ = watched[1].revents != 0;
  for (std::size_t index = 0; index < clients_.size(); ++index) {
    clients_[index].readable = (watched[index + 2].revents & (POLLIN | POLLHUP | POLLERR)) != 0;
    clients_[index].writable = (watched[index + 2].revents & POLLOUT) != 0;
  }
}

void PanelServer::serve(const PanelImage& image, const std::function<void(const PanelCommands&)>& on_commands) {
  std::erase_if(clients_, [&](Client& client) {
    if (client.readable || client.writable) next_turn_ = Clock::now() + kTurn;
    const bool stays = serve_client(client, image, on_commands);
    if (!stays) close(client.descriptor);
    return !stays;
  });
  if (connection_waiting_) accept_clients();
  connection_waiting_ = false;
}

bool PanelServer::has_told_all(Clock::time_point since) const {
  return std::ranges::none_of(clients_, [since](const Client& client) {
    const bool waits = client.last_request < since || !client.unsent.empty();
    return client.asks && waits && since - client.last_request < kAsksNowAndThen;
  });
}

void PanelServer::accept_clients() {
  for (std::size_t count = 0; count < kMostClients; ++count) {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    const int descriptor =
        accept4(listener_, reinterpret_cast<sockaddr*>(&address), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (descriptor < 0) return;
    std::string name = numeric_address(address, size);
    if (is_allowed(name)) {
      make_room(name);
      add_client(descriptor, std::move(name));
    } else {
      close(descriptor);
    }
  }
}

void PanelServer::add_client(int descriptor, std::string address) {
  const int on = 1;
  // Answers are small and wanted at once; a failure here only costs time.
  [[maybe_unused]] const int result = setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  clients_.push_back({.descriptor = descriptor,
                      .address = std::move(address),
                      .received = {},
                      .unsent = {},
                      .last_request = Clock::now()});
}

bool PanelServer::is_allowed(const std::string& address) const {
  return settings_.allow.empty() || std::ranges::find(settings_.allow, address) != settings_.allow.end();
}

// Clients that went away without a word, or are polite but many, must not lock the operator out: the one that has been
// silent for longest makes room, of the same address where that has its share.
void PanelServer::make_room(const std::string& address) {
  const auto of_address = [&address](const Client& client) { return client.address == address; };
  const bool has_its_share = static_cast<std::size_t>(std::ranges::count_if(clients_, of_address)) >= kMostOfAnAddress;
  if (!has_its_share && clients_.size() < kMostClients) return;
  auto longest = clients_.end();
  for (auto client = clients_.begin(); client != clients_.end(); ++client) {
    if (has_its_share && !of_address(*client)) continue;
    if (longest == clients_.end() || client->last_request < longest->last_request) longest = client;
  }
  close(longest->descriptor);
  clients_.erase(longest);
}

bool PanelServer::serve_client(Client& client, const PanelImage& image,
                               const std::function<void(const PanelCommands&)>& on_commands) const {
  if (client.writable) return answer(client, image, on_commands);
  if (!client.readable) return true;
  client.readable = false;
  std::array<std::uint8_t, kAnswersPerTurn*(kHeaderSize + kLongestPdu)> chunk;
  const ssize_t count = recv(client.descriptor, chunk.data(), chunk.size() - client.received.size(), 0);
  if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) return false;
  if (count > 0) client.received.insert(client.received.end(), chunk.begin(), chunk.begin() + count);
  return answer(client, image, on_commands);
}

// Answers the whole requests received, as far as the client takes the answers. False when it must be dropped.
bool PanelServer::answer(Client& client, const PanelImage& image,
                         const std::function<void(const PanelCommands&)>& on_commands) const {
  std::size_t used = 0;
  while (client.received.size() - used > kHeaderSize) {
    const std::uint8_t* const header = client.received.data() + used;
    const std::size_t length = static_cast<std::size_t>(header[kLengthOffset] << 8U) + header[kLengthOffset + 1];
    // A wrong protocol or length leaves no way to find the next request.
    if (header[2] != 0 || header[3] != 0 || length < 2 || length > kLongestPdu + 1) return false;
    const std::size_t size = kLengthOffset + 2 + length;
    if (client.received.size() - used < size) break;
    PanelCommands commands;
    const std::span<const std::uint8_t> request(header + kHeaderSize, length - 1);
    // Over TCP the panel is the only unit at its address, whichever one is asked; the answer names the same.
    const std::vector<std::uint8_t> pdu = answer_panel_request(request, image, settings_.commands, commands);
    client.unsent.insert(client.unsent.end(), header, header + kLengthOffset);
    client.unsent.push_back(static_cast<std::uint8_t>((pdu.size() + 1) >> 8U));
    client.unsent.push_back(static_cast<std::uint8_t>((pdu.size() + 1) & 0xFFU));
    client.unsent.push_back(header[kUnitOffset]);
    client.unsent.insert(client.unsent.end(), pdu.begin(), pdu.end());
    client.last_request = Clock::now();
    client.asks = true;
    on_commands(commands);
    used += size;
  }
  client.received.erase(client.received.begin(), client.received.begin() + static_cast<std::ptrdiff_t>(used));
  client.writable = false;
  if (client.unsent.empty()) return true;
  const ssize_t sent = send(client.descriptor, client.unsent.data(), client.unsent.size(), MSG_NOSIGNAL);
  if (sent < 0) return errno == EAGAIN || errno == EINTR;
  client.unsent.erase(client.unsent.begin(), client.unsent.begin() + sent);
  return true;
}

}  // namespace bladefit
