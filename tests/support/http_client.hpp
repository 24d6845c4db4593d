#pragma once
#include <chrono>
#include <cstdint>
#include <string>

namespace bladefit::testing {

/// A TCP connection to this machine, for requests as they stand.
class HttpConnection {
 public:
  /// Throws std::runtime_error where nobody listens.
  explicit HttpConnection(std::uint16_t port);
  ~HttpConnection();
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void send(const std::string& text) const;

  /// What comes until `end` is among it, the server closes, or time is over; what came before is part of it.
  [[nodiscard]] const std::string& receive(const std::string& end, std::chrono::milliseconds patience);

  /// Whether the server has closed it within this time; what comes meanwhile is dropped.
  [[nodiscard]] bool closes(std::chrono::milliseconds patience) const;

 private:
  int descriptor_;
  std::string received_;
};

/// A whole answer.
struct HttpAnswer {
  int status = 0;
  std::string head, body;
};

/// Asks once. `host`: the Host header; empty: the address itself. `headers`: further lines, each ended by CR LF.
[[nodiscard]] HttpAnswer http_ask(std::uint16_t port, const std::string& method, const std::string& path,
                                  const std::string& body = "", const std::string& headers = "",
                                  const std::string& host = "");

}  // namespace bladefit::testing
