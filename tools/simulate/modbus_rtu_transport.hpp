#pragma once
#include "tools/simulate/modbus_responder.hpp"
#include "tools/simulate/pseudo_terminal.hpp"
#include "tools/simulate/transport.hpp"

namespace bladefit::simulate {

/// The machine as a Modbus RTU server at the end of a pseudo terminal.
class ModbusRtuTransport : public Transport {
 public:
  /// `link` as in PseudoTerminal; `unit` is the server's address on the line, 1..247. Throws ToolError (device).
  ModbusRtuTransport(Machine& machine, const std::string& link, int unit, std::uint16_t map_version,
                     const FaultSettings& faults, const Log& log);

  [[nodiscard]] std::string address() const override { return "over Modbus RTU on " + terminal_.path(); }
  [[nodiscard]] std::vector<pollfd> interests() const override { return {{terminal_.descriptor(), POLLIN, 0}}; }
  [[nodiscard]] std::optional<Clock::time_point> next_wakeup() const override;
  void publish(Clock::time_point now) override;
  void service(std::span<const pollfd> events, Clock::time_point now) override;
  [[nodiscard]] bool has_reader() const override { return has_reader_; }

 private:
  struct LateAnswer {
    Clock::time_point due;
    std::string bytes;
  };

  void answer_request(Clock::time_point now);
  void send(const std::string& bytes);
  void hang_up();

  const Log& log_;
  PseudoTerminal terminal_;
  ModbusResponder responder_;
  std::vector<LateAnswer> late_;
  bool has_reader_ = false;
};

}  // namespace bladefit::simulate
