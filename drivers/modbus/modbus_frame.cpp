#include "drivers/modbus/modbus_frame.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace bladefit {
namespace {

constexpr std::uint8_t kRefusedBit = 0x80;
constexpr std::size_t kReadReplyHead = 2;   ///< function, count of bytes
constexpr std::size_t kWriteReplySize = 5;  ///< function, address, count or value

void add_word(ModbusPdu& pdu, std::uint16_t word) {
  pdu.bytes[pdu.size++] = static_cast<std::uint8_t>(word >> 8U);
  pdu.bytes[pdu.size++] = static_cast<std::uint8_t>(word & 0xFFU);
}

bool writes(const ModbusRequest& request) {
  return request.function == MODBUS_FC_WRITE_SINGLE_REGISTER || request.function == MODBUS_FC_WRITE_MULTIPLE_REGISTERS;
}

}  // namespace

ModbusPdu encode_request(const ModbusRequest& request) {
  ModbusPdu pdu;
  pdu.bytes[pdu.size++] = request.function;
  add_word(pdu, request.address);
  if (request.function == MODBUS_FC_WRITE_SINGLE_REGISTER) {
    add_word(pdu, request.values[0]);
    return pdu;
  }
  add_word(pdu, request.count);
  if (request.function != MODBUS_FC_WRITE_MULTIPLE_REGISTERS) return pdu;
  pdu.bytes[pdu.size++] = static_cast<std::uint8_t>(2 * request.count);
  for (std::size_t index = 0; index < request.count; ++index) add_word(pdu, request.values[index]);
  return pdu;
}

std::size_t reply_size(const ModbusRequest& request) {
  return writes(request) ? kWriteReplySize : kReadReplyHead + 2 * std::size_t{request.count};
}

ReplyKind match_reply(std::span<const std::uint8_t> pdu, const ModbusRequest& request,
                      std::span<std::uint16_t> registers, std::string& fault) {
  if (pdu.size() == 2 && pdu[0] == (request.function | kRefusedBit)) {
    fault = fmt::format("the device refuses function {} at register {}: {}", request.function, request.address,
                        modbus_strerror(MODBUS_ENOBASE + pdu[1]));
    const bool busy = pdu[1] == MODBUS_EXCEPTION_ACKNOWLEDGE || pdu[1] == MODBUS_EXCEPTION_SLAVE_OR_SERVER_BUSY;
    if (pdu[1] == MODBUS_EXCEPTION_ILLEGAL_FUNCTION) return ReplyKind::unknown;
    if (pdu[1] == MODBUS_EXCEPTION_ILLEGAL_DATA_ADDRESS) return ReplyKind::absent;
    if (!busy) return ReplyKind::refused;
    fault += "; end what keeps it busy";
    return ReplyKind::busy;
  }
  if (pdu.size() != reply_size(request) || pdu[0] != request.function) return ReplyKind::foreign;
  if (writes(request)) {
    const ModbusPdu sent = encode_request(request);
    const bool same = std::equal(pdu.begin(), pdu.end(), sent.bytes.begin());
    return same ? ReplyKind::good : ReplyKind::foreign;
  }
  if (pdu[1] != 2 * request.count) return ReplyKind::foreign;
  for (std::size_t index = 0; index < request.count; ++index) {
    const std::size_t byte = kReadReplyHead + 2 * index;
    registers[index] = static_cast<std::uint16_t>((pdu[byte] << 8U) | pdu[byte + 1]);
  }
  return ReplyKind::good;
}

std::array<std::uint8_t, kTcpHeaderSize> tcp_header(std::uint16_t transaction, std::uint8_t unit,
                                                    std::size_t pdu_size) {
  const std::size_t length = pdu_size + 1;
  return {static_cast<std::uint8_t>(transaction >> 8U), static_cast<std::uint8_t>(transaction & 0xFFU), 0,   0,
          static_cast<std::uint8_t>(length >> 8U),      static_cast<std::uint8_t>(length & 0xFFU),      unit};
}

}  // namespace bladefit
