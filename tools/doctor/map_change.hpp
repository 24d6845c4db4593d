#pragma once
#include <optional>
#include <string>
#include <vector>

#include "drivers/modbus/modbus_settings.hpp"

namespace bladefit {

/// Another way to read a register map.
struct MapChange {
  RegisterTable table = RegisterTable::input;
  RegisterOrder order{WordOrder::high_first};
  int header_shift = 0;  ///< of the addresses of the header fields: -1, 0 or 1
  int record_shift = 0;  ///< of the address of the ring
  bool without_crc = false;
};

/// No change at all.
[[nodiscard]] MapChange unchanged(const CmmMap& map);

/// The ways to read a header, those with fewer changes first: both tables, every order of words and bytes, addresses
/// one lower and one higher.
[[nodiscard]] std::vector<MapChange> header_changes(const CmmMap& map);

/// The ways to read the records where the header is read as `header` says, those with fewer changes first: addresses
/// one lower and one higher, with and without the CRC.
[[nodiscard]] std::vector<MapChange> record_changes(const CmmMap& map, const MapChange& header);

/// How many settings differ.
[[nodiscard]] int size_of(const MapChange& change, const CmmMap& map);

/// The map with the change; nothing where an address would leave 0..65535.
[[nodiscard]] std::optional<CmmMap> changed(const CmmMap& map, const MapChange& change);

/// What to write into the device file for it, each with its table, such as `[map] address_base = 1`.
[[nodiscard]] std::vector<std::string> settings_of(const MapChange& change, const CmmMap& map);

}  // namespace bladefit
