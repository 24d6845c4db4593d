#include "tools/simulate/modbus_rtu_transport.hpp"

#include "tools/files/tool_error.hpp"

namespace bladefit::simulate {
namespace {

constexpr int kBaud = 115200;

/// libmodbus frames and checks for us; the line itself is the master of our terminal, which it never opens.
ModbusContext make_context(const std::string& device, int unit) {
  ModbusContext context(modbus_new_rtu(device.c_str(), kBaud, 'N', 8, 1));
  if (!context || modbus_set_slave(context.get(), unit) != 0) {
    throw ToolError(fmt::format("{}: cannot serve unit {}: {}", device, unit, modbus_strerror(errno)),
                    ToolError::Kind::device);
  }
  return context;
}

}  // namespace

ModbusRtuTransport::ModbusRtuTransport(Machine& machine, const std::string& link, int unit, std::uint16_t map_version,
                                       const FaultSettings& faults, const Log& log)
    : log_(log),
      terminal_(link),
      responder_(make_context(terminal_.path(), unit), machine, map_version, faults, false, log) {}

std::optional<Clock::time_point> ModbusRtuTransport::next_wakeup() const {
  std::optional<Clock::time_point> earliest;
  for (const LateAnswer& late : late_) {
    if (!earliest || late.due < *earliest) earliest = late.due;
  }
  return earliest;
}

void ModbusRtuTransport::publish(Clock::time_point) { responder_.publish(); }

void ModbusRtuTransport::service(std::span<const pollfd> events, Clock::time_point now) {
  const short event = events_of(events, terminal_.descriptor());
  if ((event & POLLIN) != 0) {
    answer_request(now);
  } else if (event != 0) {
    hang_up();
  }
  for (const LateAnswer& late : late_) {
    if (late.due <= now) send(late.bytes);
  }
  std::erase_if(late_, [now](const LateAnswer& late) { return late.due <= now; });
}

void ModbusRtuTransport::answer_request(Clock::time_point now) {
  has_reader_ = true;
  ModbusAnswer answer = responder_.receive(terminal_.descriptor(), now);
  if (answer.hang_up) {
    hang_up();
  } else if (answer.delay.count() > 0) {
    late_.push_back({now + answer.delay, std::move(answer.bytes)});
  } else if (!answer.bytes.empty()) {
    send(answer.bytes);
    if (answer.twice) send(answer.bytes);
  }
}

void ModbusRtuTransport::send(const std::string& bytes) {
  // Bytes that the line does not take are lost, as on a real one.
  if (terminal_.write(bytes) != bytes.size()) log_("the reader does not read; an answer was lost");
}

void ModbusRtuTransport::hang_up() {
  log_("line hung up");
  late_.clear();
  has_reader_ = false;
  terminal_.replace();
}

}  // namespace bladefit::simulate
