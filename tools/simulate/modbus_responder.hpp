#pragma once
#include <modbus/modbus.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/simulate/descriptor.hpp"
#include "tools/simulate/faults.hpp"
#include "tools/simulate/log.hpp"
#include "tools/simulate/modbus_map.hpp"

namespace bladefit::simulate {

struct FreeModbus {
  void operator()(modbus_t* context) const { modbus_free(context); }
};
using ModbusContext = std::unique_ptr<modbus_t, FreeModbus>;

/// What is to be done with the answer to a request.
struct ModbusAnswer {
  bool hang_up = false;               ///< the reader is gone, or a fault wants it to be
  std::string bytes;                  ///< empty = no answer
  bool twice = false;                 ///< the bytes are to be sent two times
  std::chrono::nanoseconds delay{0};  ///< how long the bytes are to be held back
};

/// What a Modbus server does with one request, faults included, whatever the bytes travel on. libmodbus writes its
/// answers into a pair of sockets of ours, so that they can be lost, held back or doubled.
class ModbusResponder {
 public:
  /// Throws ToolError (device).
  ModbusResponder(ModbusContext context, Machine& machine, std::uint16_t version, const FaultSettings& faults,
                  bool frames_are_numbered, const Log& log);

  void publish() { map_.publish(machine_); }

  /// Reads one request from a readable descriptor and makes its answer.
  [[nodiscard]] ModbusAnswer receive(int descriptor, Clock::time_point now);

 private:
  /// The registers that a request reads or writes.
  struct Request {
    int function = 0;
    std::uint32_t address = 0;
    std::uint32_t count = 0;
  };

  [[nodiscard]] Request parse(std::string_view bytes) const;
  [[nodiscard]] std::string reply(std::string_view request);
  [[nodiscard]] ModbusAnswer answer(std::string_view bytes, const Request& request);
  [[nodiscard]] std::optional<std::uint32_t> first_record(const Request& request) const;
  [[nodiscard]] std::string corrupted_reply(std::string_view bytes, const Request& request);
  [[nodiscard]] ModbusAnswer duplicated_reply(std::string_view bytes, const Request& request);
  [[nodiscard]] std::string reply_with(std::string_view bytes, std::span<std::uint16_t> registers,
                                       std::span<const std::uint16_t> instead);

  ModbusContext context_;
  Machine& machine_;
  ModbusMap map_;
  FaultSource faults_;
  bool frames_are_numbered_;
  const Log& log_;
  Descriptor capture_in_;
  Descriptor capture_out_;
};

}  // namespace bladefit::simulate
