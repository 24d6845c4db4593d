#pragma once
#include <string>
#include <string_view>

#include "tools/simulate/faults.hpp"
#include "tools/simulate/log.hpp"
#include "tools/simulate/pseudo_terminal.hpp"
#include "tools/simulate/transport.hpp"

namespace bladefit::simulate {

/// A line of serial protocol v1 with its check sum and end, for example frame("ACK,12").
[[nodiscard]] std::string frame(std::string_view content);

/// The line of a record.
[[nodiscard]] std::string record_line(std::uint32_t sequence, const MachinePoint& point);

/// The machine on a serial line: serial protocol v1 at the end of a pseudo terminal.
class SerialTransport : public Transport {
 public:
  /// `link` as in PseudoTerminal. Throws ToolError (device).
  SerialTransport(Machine& machine, const std::string& link, const FaultSettings& faults, const Log& log);

  [[nodiscard]] std::string address() const override { return "over a serial line on " + terminal_.path(); }
  [[nodiscard]] std::vector<pollfd> interests() const override;
  [[nodiscard]] std::optional<Clock::time_point> next_wakeup() const override;
  void publish(Clock::time_point now) override;
  void service(std::span<const pollfd> events, Clock::time_point now) override;
  [[nodiscard]] bool has_reader() const override { return has_reader_; }

 private:
  struct HeldLine {
    Clock::time_point due;
    std::string line;
  };

  void read_lines(Clock::time_point now);
  void obey(std::string_view line, Clock::time_point now);
  void start(std::uint32_t first, Clock::time_point now);
  void resend(std::uint32_t first_missing);
  void send_record(std::uint32_t sequence, Clock::time_point now);
  void flush();
  void hang_up();

  Machine& machine_;
  const Log& log_;
  PseudoTerminal terminal_;
  FaultSource faults_;
  std::string input_;
  std::string output_;
  std::vector<HeldLine> held_;
  std::optional<Clock::time_point> end_due_;  ///< when END is to be sent (again)
  std::uint32_t sent_ = 0;
  bool streaming_ = false;
  bool has_reader_ = false;
};

}  // namespace bladefit::simulate
