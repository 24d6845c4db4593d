#pragma once
#include <list>

#include "tools/simulate/modbus_responder.hpp"
#include "tools/simulate/transport.hpp"

namespace bladefit::simulate {

/// The machine as a Modbus TCP server on the loopback address, for several readers at once.
class ModbusTcpTransport : public Transport {
 public:
  /// `port` 0 = any free one. Throws ToolError (device) when the port cannot be had.
  ModbusTcpTransport(Machine& machine, int port, std::uint16_t map_version, const FaultSettings& faults,
                     const Log& log);

  [[nodiscard]] std::string address() const override;
  [[nodiscard]] std::vector<pollfd> interests() const override;
  [[nodiscard]] std::optional<Clock::time_point> next_wakeup() const override;
  void publish(Clock::time_point now) override;
  void service(std::span<const pollfd> events, Clock::time_point now) override;
  [[nodiscard]] bool has_reader() const override { return !readers_.empty(); }

 private:
  struct LateAnswer {
    Clock::time_point due;
    std::string bytes;
  };
  struct Reader {
    Descriptor socket;
    std::vector<LateAnswer> late;
    bool gone = false;
  };

  void accept_reader();
  void answer_request(Reader& reader, Clock::time_point now);
  void send_late(Reader& reader, Clock::time_point now);
  void send(Reader& reader, const std::string& bytes) const;

  const Log& log_;
  Descriptor listener_;
  int port_ = 0;
  std::optional<ModbusResponder> responder_;
  std::list<Reader> readers_;
};

}  // namespace bladefit::simulate
