#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "drivers/modbus/modbus_settings.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// What the header registers of a CMM say. Fields that the device lacks have the value that a good device would show.
struct CmmHeader {
  std::uint32_t version = 0;
  std::uint16_t status = 0;
  std::uint32_t newest = 0;       ///< sequence of the newest record; 0 = none yet
  std::uint32_t capacity = 0;     ///< [records]
  std::uint32_t record_size = 0;  ///< [registers]
  std::uint32_t run_id = 0;       ///< 0 where the device has none
  bool test_constant_provided = false;
  double test_constant = 0;
  std::optional<RegisterOrder> proven_order;  ///< another one than that of the map, which gives the constant expected
  bool status_unknown = false;                ///< the map gives no meaning to the status, which is a number

  /// True where both describe the same ring of the same run.
  [[nodiscard]] bool same_identity(const CmmHeader& other) const {
    return version == other.version && capacity == other.capacity && record_size == other.record_size &&
           run_id == other.run_id;
  }
};

/// The registers that hold every present header field.
struct RegisterBlock {
  std::uint16_t first = 0;
  std::uint16_t count = 0;
};

[[nodiscard]] RegisterBlock header_block(const CmmMap& map);

/// Decodes the registers of header_block().
[[nodiscard]] CmmHeader decode_header(std::span<const std::uint16_t> registers, const CmmMap& map);

/// Why the device cannot be read with this map: another version, word order or record size, an impossible ring.
/// Failure `device`: one phrase with the fix.
[[nodiscard]] Failure check_header(const CmmHeader& header, const CmmMap& map);

/// What to write into the device file where its registers come in this order: the settings that the map has otherwise.
[[nodiscard]] std::string order_settings(const CmmMap& map, const RegisterOrder& order);

/// Why a map contradicts itself (too many registers in the header or a record, fields that leave the record, a scale
/// that is 0 or not finite). bad_input: one phrase with the fix.
[[nodiscard]] Failure check_map(const CmmMap& map);

}  // namespace bladefit
