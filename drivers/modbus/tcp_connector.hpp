#pragma once
#include <sys/socket.h>

#include <chrono>
#include <string>
#include <vector>

#include "drivers/modbus/modbus_settings.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// Connects to a host without blocking, one of its addresses after the other.
class TcpConnector {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Progress : std::uint8_t { pending, connected, failed };

  TcpConnector() = default;
  TcpConnector(const TcpConnector&) = delete;
  TcpConnector& operator=(const TcpConnector&) = delete;
  ~TcpConnector() { stop(); }

  /// Looks the host up; this may block as long as the resolver does. `device`: a phrase with the fix.
  [[nodiscard]] Failure resolve(const TcpSettings& settings);

  /// Begins with the first address. All of them together must answer by `deadline`.
  void start(Clock::time_point deadline);

  /// Goes on until `until` at the latest.
  [[nodiscard]] Progress advance(Clock::time_point until);

  /// Hands over the connected socket (not blocking, without delay); the caller closes it.
  [[nodiscard]] int release();

  /// Why it failed, with the fix.
  [[nodiscard]] const std::string& fault() const { return fault_; }

  void stop();

 private:
  struct Address {
    sockaddr_storage storage{};
    socklen_t length = 0;
  };

  void try_next();

  std::vector<Address> addresses_;
  std::size_t next_ = 0;
  int socket_ = -1;
  Clock::time_point deadline_{};
  std::string fault_;
};

}  // namespace bladefit
