#pragma once
#include <httplib.h>
// Its header brings a macro of this name, which is a word of Eigen's.
#undef _res

#include <array>
#include <chrono>
#include <string>

namespace bladefit {

/// The connection of a client, with one deadline for its whole request and one for each piece of the answer, however
/// slowly it sends or takes bytes. Owns the socket.
class ClientStream : public httplib::Stream {
 public:
  static constexpr std::chrono::seconds kRequestTime{5};
  static constexpr std::chrono::seconds kAnswerTime{5};

  explicit ClientStream(int descriptor);
  ~ClientStream() override;
  ClientStream(const ClientStream&) = delete;
  ClientStream& operator=(const ClientStream&) = delete;

  [[nodiscard]] bool is_readable() const override;
  [[nodiscard]] bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  [[nodiscard]] int socket() const override { return descriptor_; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kBuffer = 4096;
  int descriptor_;
  Clock::time_point deadline_ = Clock::now() + kRequestTime;
  std::array<char, kBuffer> buffer_{};
  std::size_t used_ = 0, filled_ = 0;
};

}  // namespace bladefit
