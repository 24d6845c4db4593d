#pragma once
#include <modbus.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace bladefit {

/// A read or a write of neighbouring registers.
struct ModbusRequest {
  std::uint8_t function = MODBUS_FC_READ_INPUT_REGISTERS;  ///< 3, 4, 6 or 16
  std::uint16_t address = 0;
  std::uint16_t count = 0;                ///< registers; 1..125 to read, 1..4 to write
  std::array<std::uint16_t, 4> values{};  ///< to write
};

/// Bytes of a request or reply without its envelope.
struct ModbusPdu {
  std::array<std::uint8_t, MODBUS_MAX_PDU_LENGTH> bytes{};
  std::size_t size = 0;

  [[nodiscard]] std::span<const std::uint8_t> view() const { return {bytes.data(), size}; }
};

[[nodiscard]] ModbusPdu encode_request(const ModbusRequest& request);

/// Bytes of the good reply to a request, without its envelope.
[[nodiscard]] std::size_t reply_size(const ModbusRequest& request);

enum class ReplyKind : std::uint8_t {
  good,     ///< answers the request
  foreign,  ///< answers another request, such as an earlier one whose reply came late
  refused,  ///< the device refuses the request
  unknown,  ///< the device does not know the function
  absent,   ///< the device has no such register
  busy,     ///< the device refuses it for now
};

/// Compares a reply with its request. With `good` the registers that were read are in `registers`, which has room for
/// request.count of them; with every kind of refusal the reason is in `fault`.
[[nodiscard]] ReplyKind match_reply(std::span<const std::uint8_t> pdu, const ModbusRequest& request,
                                    std::span<std::uint16_t> registers, std::string& fault);

inline constexpr std::size_t kTcpHeaderSize = 7;  ///< transaction, protocol 0, length, unit

/// The header of Modbus TCP in front of a request or reply of `pdu_size` bytes.
[[nodiscard]] std::array<std::uint8_t, kTcpHeaderSize> tcp_header(std::uint16_t transaction, std::uint8_t unit,
                                                                  std::size_t pdu_size);

}  // namespace bladefit
