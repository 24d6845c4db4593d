#include "firmware_bridge/host/panel/panel_protocol.hpp"

#include <array>
#include <string_view>

namespace bladefit {
namespace {

// Function codes and exceptions of the Modbus application protocol 1.1b3, 6 and 7.
constexpr std::uint8_t kReadCoils = 1, kReadDiscreteInputs = 2, kReadHoldingRegisters = 3, kReadInputRegisters = 4,
                       kWriteCoil = 5, kWriteCoils = 15, kEncapsulated = 43;
constexpr std::uint8_t kDeviceIdentification = 14;
constexpr std::uint8_t kIllegalFunction = 1, kIllegalAddress = 2, kIllegalValue = 3;
constexpr std::uint8_t kExceptionFlag = 0x80;
constexpr std::uint16_t kMostRegisters = 125, kMostBits = 2000;
constexpr std::uint16_t kCoilOn = 0xFF00, kCoilOff = 0;
constexpr std::size_t kReadRequestSize = 5;
constexpr std::size_t kWriteCoilsHeader = 6;
constexpr std::size_t kIdentifyRequestSize = 4;

using Bytes = std::vector<std::uint8_t>;
using Coils = std::array<bool, kPanelCoils>;

std::uint16_t word_at(std::span<const std::uint8_t> bytes, std::size_t offset) {
  return static_cast<std::uint16_t>((bytes[offset] << 8U) | bytes[offset + 1]);
}

Bytes exception(std::span<const std::uint8_t> request, std::uint8_t code) {
  return {static_cast<std::uint8_t>(request[0] | kExceptionFlag), code};
}

Bytes read_registers(std::span<const std::uint8_t> request, const PanelImage& image) {
  const std::size_t first = word_at(request, 1);
  const std::size_t count = word_at(request, 3);
  if (count == 0 || count > kMostRegisters) return exception(request, kIllegalValue);
  if (!PanelImage::can_read(first, count)) return exception(request, kIllegalAddress);
  Bytes answer = {request[0], static_cast<std::uint8_t>(2 * count)};
  for (const std::uint16_t word : std::span(image.registers).subspan(first, count)) {
    answer.push_back(static_cast<std::uint8_t>(word >> 8U));
    answer.push_back(static_cast<std::uint8_t>(word & 0xFFU));
  }
  return answer;
}

/// Function 43/14: who made this. A stream has every object from the first one on.
Bytes identify(std::span<const std::uint8_t> request) {
  static constexpr std::array<std::string_view, 3> kObjects = {"bladefit", "bladefit panel", BLADEFIT_VERSION};
  constexpr std::uint8_t kOneObject = 4, kBasicStreamAndSingly = 0x81;
  const std::uint8_t code = request[2], object = request[3];
  if (code == 0 || code > kOneObject) return exception(request, kIllegalValue);
  if (code == kOneObject && object >= kObjects.size()) return exception(request, kIllegalAddress);
  const std::size_t first = object < kObjects.size() ? object : 0;
  const std::size_t count = code == kOneObject ? 1 : kObjects.size() - first;
  Bytes answer = {request[0], request[1], code, kBasicStreamAndSingly, 0, 0, static_cast<std::uint8_t>(count)};
  for (std::size_t index = first; index < first + count; ++index) {
    answer.push_back(static_cast<std::uint8_t>(index));
    answer.push_back(static_cast<std::uint8_t>(kObjects[index].size()));
    answer.insert(answer.end(), kObjects[index].begin(), kObjects[index].end());
  }
  return answer;
}

Bytes read_bits(std::span<const std::uint8_t> request, std::span<const bool> bits) {
  const std::size_t first = word_at(request, 1);
  const std::size_t count = word_at(request, 3);
  if (count == 0 || count > kMostBits) return exception(request, kIllegalValue);
  if (first + count > bits.size()) return exception(request, kIllegalAddress);
  const std::size_t bytes = (count + 7) / 8;
  Bytes answer(2 + bytes, 0);
  answer[0] = request[0];
  answer[1] = static_cast<std::uint8_t>(bytes);
  for (std::size_t bit = 0; bit < count; ++bit) {
    if (bits[first + bit]) answer[2 + bit / 8] |= static_cast<std::uint8_t>(1U << (bit % 8));
  }
  return answer;
}

PanelCommands commands_of(const Coils& coils) { return {coils[0], coils[1], coils[2], coils[3]}; }

// The answer to a write repeats its first five bytes.
Bytes written(std::span<const std::uint8_t> request) { return Bytes(request.begin(), request.begin() + 5); }

Bytes write_coil(std::span<const std::uint8_t> request, PanelCommands& commands) {
  const std::size_t coil = word_at(request, 1);
  const std::uint16_t value = word_at(request, 3);
  if (value != kCoilOn && value != kCoilOff) return exception(request, kIllegalValue);
  if (coil >= kPanelCoils) return exception(request, kIllegalAddress);
  Coils coils{};
  coils[coil] = value == kCoilOn;
  commands = commands_of(coils);
  return written(request);
}

Bytes write_coils(std::span<const std::uint8_t> request, PanelCommands& commands) {
  const std::size_t first = word_at(request, 1);
  const std::size_t count = word_at(request, 3);
  const std::size_t bytes = (count + 7) / 8;
  if (count == 0 || count > kMostBits || request.size() != kWriteCoilsHeader + bytes || request[5] != bytes) {
    return exception(request, kIllegalValue);
  }
  if (first + count > kPanelCoils) return exception(request, kIllegalAddress);
  Coils coils{};
  for (std::size_t bit = 0; bit < count; ++bit) coils[first + bit] = (request[kWriteCoilsHeader] >> bit & 1U) != 0;
  commands = commands_of(coils);
  return written(request);
}

}  // namespace

std::vector<std::uint8_t> answer_panel_request(std::span<const std::uint8_t> request, const PanelImage& image,
                                               bool commands_enabled, PanelCommands& commands) {
  const std::uint8_t function = request[0];
  if (function == kEncapsulated && request.size() == kIdentifyRequestSize && request[1] == kDeviceIdentification)
    return identify(request);
  const bool writing = function == kWriteCoil || function == kWriteCoils;
  const bool reading = function >= kReadCoils && function <= kReadInputRegisters;
  if (!reading && !(writing && commands_enabled)) return exception(request, kIllegalFunction);
  const bool long_enough =
      function == kWriteCoils ? request.size() > kWriteCoilsHeader : request.size() == kReadRequestSize;
  if (!long_enough) return exception(request, kIllegalValue);
  switch (function) {
    case kReadHoldingRegisters:
    case kReadInputRegisters:
      return read_registers(request, image);
    case kReadDiscreteInputs:
      return read_bits(request, image.discrete);
    case kReadCoils:
      // A coil is a button: it is never seen pressed.
      return read_bits(request, std::array<bool, kPanelDiscreteInputs>{});
    case kWriteCoil:
      return write_coil(request, commands);
    default:
      return write_coils(request, commands);
  }
}

}  // namespace bladefit
