#pragma once
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace bladefit {

/// Whether the Host header of a request names this server by a number or as localhost, at its port. A page of elsewhere
/// whose name was made to point here (DNS rebinding) asks by that name, and is refused. `bound`: the address listened
/// at; where that is one of all addresses every numeric one is this server's.
[[nodiscard]] bool is_own_host(std::string_view header, const std::string& bound, std::uint16_t port);

/// Whether an address is one of this machine alone.
[[nodiscard]] bool is_loopback(const std::string& address);

/// Compares in a time that depends on the length of `given` alone.
[[nodiscard]] bool same_secret(std::string_view given, std::string_view secret);

/// Counts wrong tokens, so that nobody tries many. Any thread.
class TokenGuard {
 public:
  static constexpr int kMostWrong = 10;
  static constexpr std::chrono::seconds kWithin{10};

  explicit TokenGuard(std::string token) : token_(std::move(token)) {}

  enum class Answer : std::uint8_t { accepted, refused, too_many, no_commands };

  /// `header`: that named Authorization, "Bearer TOKEN".
  [[nodiscard]] Answer check(std::string_view header);

  [[nodiscard]] bool has_token() const { return !token_.empty(); }

 private:
  using Clock = std::chrono::steady_clock;
  std::string token_;
  std::mutex mutex_;
  int wrong_ = 0;
  Clock::time_point since_{};
};

}  // namespace bladefit
