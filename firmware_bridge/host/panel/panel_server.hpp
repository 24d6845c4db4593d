#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "drivers/source/failure.hpp"
#include "firmware_bridge/host/panel/panel_protocol.hpp"

namespace bladefit {

struct PanelServerSettings {
  std::string host = "127.0.0.1";    ///< address to listen at; Modbus has no authentication, so loopback by default
  std::uint16_t port = 1503;         ///< 0 = any free port
  bool commands = false;             ///< whether clients may press the coils
  PanelFormat format{};              ///< of the numbers
  std::vector<std::string> allow{};  ///< numeric addresses that may connect; empty = every one that reaches `host`
};

/// Modbus TCP server of the panel. It speaks the protocol itself, because the server half of libmodbus waits for slow
/// clients and sleeps after a bad request; here no socket call waits, so that no client can hold up another one or the
/// host. One thread owns it.
class PanelServer {
 public:
  static constexpr std::size_t kMostClients = 128;
  static constexpr std::size_t kMostOfAnAddress = 64;  ///< so that one machine cannot lock out the others

  PanelServer() = default;
  ~PanelServer();
  PanelServer(const PanelServer&) = delete;
  PanelServer& operator=(const PanelServer&) = delete;

  /// Starts to listen. bad_input for an address that does not exist here, `device` for a port in use.
  [[nodiscard]] Failure open(const PanelServerSettings& settings);

  /// The port listened at.
  [[nodiscard]] std::uint16_t port() const { return port_; }

  /// How the numbers are to be sent.
  [[nodiscard]] const PanelFormat& format() const { return settings_.format; }

  /// Waits until a client wants something, `wakeup_descriptor` becomes readable, or `timeout` is over. Clients wait for
  /// kTurn after those before them were served: however many ask without a pause, they leave the processor to others.
  void wait(int wakeup_descriptor, std::chrono::milliseconds timeout);

  /// Serves, from the image, what wait() found. Each client gets a few answers a call, however many it asks for.
  void serve(const PanelImage& image, const std::function<void(const PanelCommands&)>& on_commands);

  /// Whether every client that asks now and then has had an answer since `since`.
  [[nodiscard]] bool has_told_all(std::chrono::steady_clock::time_point since) const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Client {
    int descriptor = -1;
    std::string address;
    std::vector<std::uint8_t> received;
    std::vector<std::uint8_t> unsent;
    Clock::time_point last_request;  ///< or, before the first one, when it came
    bool asks = false;               ///< it has asked
    bool readable = false, writable = false;
  };

  void accept_clients();
  void add_client(int descriptor, std::string address);
  void make_room(const std::string& address);
  [[nodiscard]] bool is_allowed(const std::string& address) const;
  [[nodiscard]] bool serve_client(Client& client, const PanelImage& image,
                                  const std::function<void(const PanelCommands&)>& on_commands) const;
  [[nodiscard]] bool answer(Client& client, const PanelImage& image,
                            const std::function<void(const PanelCommands&)>& on_commands) const;

  PanelServerSettings settings_;
  std::uint16_t port_ = 0;
  int listener_ = -1;
  bool connection_waiting_ = false;
  Clock::time_point next_turn_{};  ///< of clients
  std::vector<Client> clients_;
};

}  // namespace bladefit
