#include "tools/simulate/modbus_responder.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include "tools/files/tool_error.hpp"

namespace bladefit::simulate {
namespace {

constexpr std::uint32_t kByteTimeoutUs = 100000;  ///< a reader that stops in the middle of a request is not waited for
constexpr std::uint32_t kResponseTimeoutUs = 1000;  ///< libmodbus sleeps for it before it answers a wrong address

bool is_read(int function) {
  return function == MODBUS_FC_READ_INPUT_REGISTERS || function == MODBUS_FC_READ_HOLDING_REGISTERS;
}

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  if (offset + 1 >= bytes.size()) return 0;
  return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[offset])) << 8U |
         static_cast<unsigned char>(bytes[offset + 1]);
}

}  // namespace

ModbusResponder::ModbusResponder(ModbusContext context, Machine& machine, std::uint16_t version,
                                 const FaultSettings& faults, bool frames_are_numbered, const Log& log)
    : context_(std::move(context)),
      machine_(machine),
      map_(machine, version),
      faults_(faults),
      frames_are_numbered_(frames_are_numbered),
      log_(log) {
  std::array<int, 2> pair{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, pair.data()) != 0) {
    throw ToolError("no socket left for the simulated machine; close other programs", ToolError::Kind::device);
  }
  capture_in_ = Descriptor(pair[0]);
  capture_out_ = Descriptor(pair[1]);
  modbus_set_byte_timeout(context_.get(), 0, kByteTimeoutUs);
  modbus_set_response_timeout(context_.get(), 0, kResponseTimeoutUs);
}

ModbusAnswer ModbusResponder::receive(int descriptor, Clock::time_point now) {
  std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> buffer{};
  modbus_set_socket(context_.get(), descriptor);
  const int length = modbus_receive(context_.get(), buffer.data());
  if (length <= 0) {
    // On a cable noise and requests to other units are passed over; in a TCP stream nothing can be found again.
    const bool gone = frames_are_numbered_ || (length < 0 && errno == EIO);
    if (length < 0 && !gone) modbus_flush(context_.get());
    ModbusAnswer nothing;
    nothing.hang_up = length < 0 && gone;
    return nothing;
  }
  const std::string_view bytes(reinterpret_cast<const char*>(buffer.data()), static_cast<std::size_t>(length));
  const Request request = parse(bytes);
  ModbusAnswer made = answer(bytes, request);
  const std::uint16_t command = map_.obey(machine_, now);
  if (command != 0) log_("command {}, acknowledged {}", command, machine_.acknowledged());
  publish();
  return made;
}

ModbusResponder::Request ModbusResponder::parse(std::string_view bytes) const {
  const auto header = static_cast<std::size_t>(modbus_get_header_length(context_.get()));
  Request request;
  if (bytes.size() <= header) return request;
  request.function = static_cast<unsigned char>(bytes[header]);
  request.address = word_at(bytes, header + 1);
  request.count = word_at(bytes, header + 3);
  return request;
}

std::string ModbusResponder::reply(std::string_view request) {
  modbus_set_socket(context_.get(), capture_in_.get());
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(request.data());
  if (modbus_reply(context_.get(), bytes, static_cast<int>(request.size()), map_.mapping()) < 0) {
    log_("request refused: {}", modbus_strerror(errno));
  }
  std::array<char, MODBUS_MAX_ADU_LENGTH> buffer{};
  const ssize_t length = recv(capture_out_.get(), buffer.data(), buffer.size(), 0);
  return length > 0 ? std::string(buffer.data(), static_cast<std::size_t>(length)) : std::string{};
}

ModbusAnswer ModbusResponder::answer(std::string_view bytes, const Request& request) {
  ModbusAnswer made;
  switch (faults_.draw()) {
    case Fault::disconnect:
      // The request is obeyed all the same: a reader cannot know whether a lost link has swallowed it.
      log_("fault: link closed instead of an answer to function {} at {}", request.function, request.address);
      made.bytes = reply(bytes);
      made.bytes.clear();
      made.hang_up = true;
      return made;
    case Fault::drop:
      log_("fault: no answer to function {} at {}", request.function, request.address);
      made.bytes = reply(bytes);
      made.bytes.clear();
      return made;
    case Fault::delay:
      log_("fault: late answer to function {} at {}", request.function, request.address);
      made.bytes = reply(bytes);
      made.delay = faults_.delay_time();
      return made;
    case Fault::corrupt:
      made.bytes = corrupted_reply(bytes, request);
      return made;
    case Fault::duplicate:
      return duplicated_reply(bytes, request);
    case Fault::none:
      break;
  }
  made.bytes = reply(bytes);
  return made;
}

std::optional<std::uint32_t> ModbusResponder::first_record(const Request& request) const {
  const bool reads_inputs = request.function == MODBUS_FC_READ_INPUT_REGISTERS;
  if (!reads_inputs || request.address < cmm_map_v1::kRecordsRegister) return std::nullopt;
  const std::uint32_t slot = (request.address - cmm_map_v1::kRecordsRegister) / cmm_map_v1::kRecordSize;
  if (request.count < cmm_map_v1::kRecordSize || slot >= map_.capacity()) return std::nullopt;
  return slot + 1;
}

std::string ModbusResponder::reply_with(std::string_view bytes, std::span<std::uint16_t> registers,
                                        std::span<const std::uint16_t> instead) {
  const std::vector<std::uint16_t> kept(registers.begin(), registers.end());
  std::copy(instead.begin(), instead.end(), registers.begin());
  std::string answered = reply(bytes);
  std::copy(kept.begin(), kept.end(), registers.begin());
  return answered;
}

std::string ModbusResponder::corrupted_reply(std::string_view bytes, const Request& request) {
  const std::optional<std::uint32_t> record = first_record(request);
  if (!record) return reply(bytes);
  const std::span<std::uint16_t> slot = map_.slot(*record);
  std::vector<std::uint16_t> damaged(slot.begin(), slot.end());
  const std::size_t bit = faults_.choose(damaged.size() * 16);
  damaged[bit / 16] = static_cast<std::uint16_t>(damaged[bit / 16] ^ (1U << bit % 16));
  log_("fault: bit {} of register +{} changed in the record at {}", bit % 16, bit / 16, request.address);
  return reply_with(bytes, slot, damaged);
}

ModbusAnswer ModbusResponder::duplicated_reply(std::string_view bytes, const Request& request) {
  ModbusAnswer made;
  const std::optional<std::uint32_t> record = first_record(request);
  const std::uint32_t newest = machine_.available();
  if (record && !frames_are_numbered_) {
    // As a device that has not yet written the slot: another record, whole and with a good check sum.
    const std::uint32_t older = std::max(1U, machine_.acknowledged());
    log_("fault: record at {} shown as record {}", request.address, older);
    made.bytes = reply_with(bytes, map_.slot(*record), encode_record(older, machine_.point(older)));
  } else if (!record && is_read(request.function) && request.address == 0 && newest > machine_.acknowledged()) {
    log_("fault: newest sequence shown one too low");
    std::array<std::uint16_t, 2> older{};
    put_uint32(older, newest - 1);
    made.bytes = reply_with(bytes, map_.header().subspan(cmm_map_v1::kNewestRegister, 2), older);
  } else {
    log_("fault: answer to function {} at {} sent twice", request.function, request.address);
    made.bytes = reply(bytes);
    made.twice = true;
  }
  return made;
}

}  // namespace bladefit::simulate
