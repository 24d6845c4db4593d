#include "tools/web/web_access.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <array>

#include "firmware_bridge/host/panel/panel_address.hpp"

namespace bladefit {
namespace {

/// The bytes of a numeric address; empty where it is none.
std::string address_bytes(const std::string& text) {
  std::array<char, sizeof(in6_addr)> bytes{};
  if (inet_pton(AF_INET, text.c_str(), bytes.data()) == 1) return {bytes.data(), sizeof(in_addr)};
  if (inet_pton(AF_INET6, text.c_str(), bytes.data()) == 1) return {bytes.data(), sizeof(in6_addr)};
  return {};
}

bool is_every_address(const std::string& bytes) {
  return !bytes.empty() && bytes.find_first_not_of('\0') == std::string::npos;
}

}  // namespace

bool is_loopback(const std::string& address) {
  if (address == "localhost") return true;
  constexpr char kLoopback = 127;
  const std::string bytes = address_bytes(address);
  if (bytes.size() == sizeof(in_addr)) return bytes[0] == kLoopback;
  return bytes == address_bytes("::1");
}

bool is_own_host(std::string_view header, const std::string& bound, std::uint16_t port) {
  constexpr std::uint16_t kDefaultPort = 80;
  std::string name;
  std::uint16_t named_port = kDefaultPort;
  const std::string text(header);
  if (!parse_address(text, name, named_port) && !parse_address(text + ":80", name, named_port)) return false;
  if (named_port != port) return false;
  const std::string asked = address_bytes(name), own = address_bytes(bound);
  if (is_every_address(own)) return name == "localhost" || !asked.empty();
  if (is_loopback(bound) && is_loopback(name)) return true;
  return own.empty() ? name == bound : asked == own;
}

bool same_secret(std::string_view given, std::string_view secret) {
  if (secret.empty()) return false;
  // A volatile sum: the compiler may not leave the loop early either.
  volatile unsigned char differs = given.size() == secret.size() ? 0 : 1;
  for (std::size_t k = 0; k < given.size(); ++k) {
    const auto bits = static_cast<unsigned char>(given[k] ^ secret[k % secret.size()]);
    differs = static_cast<unsigned char>(differs | bits);
  }
  return differs == 0;
}

TokenGuard::Answer TokenGuard::check(std::string_view header) {
  if (token_.empty()) return Answer::no_commands;
  constexpr std::string_view kScheme = "Bearer ";
  const bool bearer = header.starts_with(kScheme);
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (now - since_ > kWithin) {
    wrong_ = 0;
    since_ = now;
  }
  if (wrong_ >= kMostWrong) return Answer::too_many;
  if (bearer && same_secret(header.substr(kScheme.size()), token_)) return Answer::accepted;
  ++wrong_;
  return Answer::refused;
}

}  // namespace bladefit
