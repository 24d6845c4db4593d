#include "drivers/modbus/cmm_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "drivers/modbus/number_codec.hpp"
#include "drivers/source/crc16.hpp"
#include "drivers/source/direction.hpp"

namespace bladefit {
namespace {

constexpr const char* kAxes[3] = {"x", "y", "z"};

/// The CRC of a device that swaps bytes is over those of the line or over those of its numbers.
bool crc_fits(std::span<const std::uint16_t> registers, const CmmMap& map, std::uint16_t found, std::uint16_t& wanted) {
  const std::span<const std::uint16_t> covered = registers.first(map.crc.address);
  wanted = crc16(covered);
  if (found == wanted || map.byte_order != ByteOrder::low_first) return found == wanted;
  std::vector<std::uint16_t> numbers(covered.begin(), covered.end());
  std::ranges::transform(numbers, numbers.begin(), swapped_bytes);
  return found == crc16(std::span<const std::uint16_t>(numbers));
}

/// The CRC comes first: in a damaged record no other field means anything.
Failure check_identity(std::span<const std::uint16_t> registers, const CmmMap& map, std::uint32_t expected) {
  if (map.crc.present) {
    const auto found = static_cast<std::uint16_t>(decode_whole(registers, 0, map.crc, map.order()));
    std::uint16_t wanted = 0;
    if (!crc_fits(registers, map, found, wanted))
      return device_failure(fmt::format("record {}: its CRC is {:04X}, not {:04X}", expected, found, wanted));
  }
  const std::uint32_t sequence = decode_whole(registers, 0, map.sequence, map.order());
  if (sequence != expected)
    return device_failure(fmt::format("record {}: its place holds record {}", expected, sequence));
  if (!map.record_status.present) return {};
  const std::uint32_t status = decode_whole(registers, 0, map.record_status, map.order());
  if (status == map.record_good) return {};
  return device_failure(fmt::format("record {}: the device marks it as bad, status {}", expected, status));
}

}  // namespace

Failure decode_record(std::span<const std::uint16_t> registers, const CmmMap& map, std::uint32_t expected,
                      ProbePoint& point) {
  if (Failure error = check_identity(registers, map, expected)) return error;
  ProbePoint decoded;
  decoded.sequence = expected;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    decoded.position[axis] = decode_field(registers, 0, map.position[axis], map.order());
    if (!std::isfinite(decoded.position[axis]))
      return device_failure(fmt::format("record {}: {} is not a finite number", expected, kAxes[axis]));
    if (map.direction[axis].present)
      decoded.approach[axis] = decode_field(registers, 0, map.direction[axis], map.order());
  }
  if (!normalise_direction(decoded.approach)) {
    return device_failure(
        fmt::format("record {}: its direction has the length {:.6g}; correct the scale of i, j, k in the device file",
                    expected, length_of(decoded.approach)));
  }
  if (map.path.present) decoded.path = static_cast<std::uint16_t>(decode_whole(registers, 0, map.path, map.order()));
  point = decoded;
  return {};
}

}  // namespace bladefit
