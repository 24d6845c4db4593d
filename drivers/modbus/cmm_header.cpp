#include "drivers/modbus/cmm_header.hpp"

#include <fmt/format.h>
#include <modbus.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/modbus/number_codec.hpp"

namespace bladefit {
namespace {

constexpr std::uint32_t kRegisters = 65536;
constexpr double kTestConstantTolerance = 1e-6;  ///< relative; a float32 has it

std::array<const NumberField*, 7> header_fields(const CmmMap& map) {
  return {&map.version, &map.status,       &map.newest, &map.capacity, &map.reported_record_size,
          &map.run_id,  &map.test_constant};
}

struct NamedField {
  const char* name;
  const NumberField* field;
};

std::array<NamedField, 10> record_fields(const CmmMap& map) {
  return {{{"sequence", &map.sequence},
           {"x", &map.position[0]},
           {"y", &map.position[1]},
           {"z", &map.position[2]},
           {"i", &map.direction[0]},
           {"j", &map.direction[1]},
           {"k", &map.direction[2]},
           {"path", &map.path},
           {"record_status", &map.record_status},
           {"crc", &map.crc}}};
}

/// Registers from `first` to before `end`.
struct Extent {
  std::uint32_t first = kRegisters;
  std::uint32_t end = 0;
};

/// Those of every present header field, of which there is at least one: newest.
Extent header_extent(const CmmMap& map) {
  Extent extent;
  for (const NumberField* field : header_fields(map)) {
    if (!field->present) continue;
    extent.first = std::min<std::uint32_t>(extent.first, field->address);
    extent.end = std::max<std::uint32_t>(extent.end, field->address + register_count(field->type));
  }
  return extent;
}

Failure check_header_place(const CmmMap& map) {
  const Extent extent = header_extent(map);
  if (extent.end > kRegisters) return bad_input("a header field ends beyond register 65535; correct its address");
  const std::uint32_t count = extent.end - extent.first;
  if (count <= MODBUS_MAX_READ_REGISTERS) return {};
  return bad_input(
      fmt::format("the header fields span {} registers; one read takes at most {}", count, MODBUS_MAX_READ_REGISTERS));
}

Failure check_record_fields(const CmmMap& map) {
  if (map.record_size == 0 || map.record_size > MODBUS_MAX_READ_REGISTERS) {
    return bad_input(
        fmt::format("record_size is {} registers; one read takes 1..{}", map.record_size, MODBUS_MAX_READ_REGISTERS));
  }
  if (map.crc.present && map.crc.type != NumberType::uint16)
    return bad_input("crc is not a uint16; CRC-16/MODBUS takes one register");
  for (const NamedField& named : record_fields(map)) {
    if (!named.field->present) continue;
    if (!std::isfinite(named.field->scale) || named.field->scale == 0) {
      return bad_input(
          fmt::format("the scale of {} is {}; give a number other than 0", named.name, named.field->scale));
    }
    const std::uint32_t end = named.field->address + std::uint32_t{register_count(named.field->type)};
    if (end > map.record_size) {
      return bad_input(
          fmt::format("{} ends at offset {}, beyond the {} registers of a record; correct its offset or record_size",
                      named.name, end - 1, map.record_size));
    }
  }
  return {};
}

template <typename Names, typename Order>
std::string_view name_of(const Names& names, Order order) {
  return std::ranges::find(names, order, &std::pair<std::string_view, Order>::second)->first;
}

bool near(double value, double expected) {
  return std::abs(value - expected) <= kTestConstantTolerance * std::abs(expected);
}

/// The order in which the test constant is the one expected, and the version, where that can tell two of them apart.
std::optional<RegisterOrder> proven_order(std::span<const std::uint16_t> registers, const CmmMap& map,
                                          std::uint16_t first) {
  std::optional<RegisterOrder> proven;
  for (const auto& [word_name, words] : kWordOrders) {
    for (const auto& [byte_name, bytes] : kByteOrders) {
      const RegisterOrder order(words, bytes);
      if (!near(decode_field(registers, first, map.test_constant, order), map.expected_test_constant)) continue;
      const bool version_fits =
          !map.version.present || decode_whole(registers, first, map.version, order) == map.expected_version;
      if (!proven || version_fits) proven = order;
      if (version_fits) return proven;
    }
  }
  return proven;
}

/// The status as bits, whatever it is.
std::uint16_t status_bits(std::uint16_t status, const CmmMap& map, bool& unknown) {
  if (map.status_values.empty() || !map.status.present) return status;
  const auto found = std::ranges::find(map.status_values, status, &std::pair<std::uint16_t, std::uint16_t>::second);
  unknown = found == map.status_values.end();
  return unknown ? std::uint16_t{0} : found->first;
}

}  // namespace

RegisterBlock header_block(const CmmMap& map) {
  const Extent extent = header_extent(map);
  return {static_cast<std::uint16_t>(extent.first), static_cast<std::uint16_t>(extent.end - extent.first)};
}

CmmHeader decode_header(std::span<const std::uint16_t> registers, const CmmMap& map) {
  const std::uint16_t first = header_block(map).first;
  const auto whole = [&](const NumberField& field, std::uint32_t otherwise) {
    return field.present ? decode_whole(registers, first, field, map.order()) : otherwise;
  };
  CmmHeader header;
  header.version = whole(map.version, map.expected_version);
  header.status = status_bits(static_cast<std::uint16_t>(whole(map.status, 0)), map, header.status_unknown);
  header.newest = whole(map.newest, 0);
  header.capacity = map.ring_capacity != 0 ? map.ring_capacity : whole(map.capacity, 0);
  header.record_size = whole(map.reported_record_size, map.record_size);
  header.run_id = whole(map.run_id, 0);
  if (map.test_constant.present) {
    const auto words = registers.subspan(static_cast<std::size_t>(map.test_constant.address - first),
                                         register_count(map.test_constant.type));
    header.test_constant_provided =
        std::any_of(words.begin(), words.end(), [](std::uint16_t word) { return word != 0; });
    header.test_constant = decode_field(registers, first, map.test_constant, map.order());
    if (!near(header.test_constant, map.expected_test_constant))
      header.proven_order = proven_order(registers, map, first);
  }
  return header;
}

Failure check_header(const CmmHeader& header, const CmmMap& map) {
  if (header.proven_order) {
    return device_failure(fmt::format("its registers come in another order; set {} in the device file",
                                      order_settings(map, *header.proven_order)));
  }
  if (header.version != map.expected_version) {
    return device_failure(
        fmt::format("it has register map version {}, not {}; give a device file that describes its map", header.version,
                    map.expected_version));
  }
  if (header.test_constant_provided && !near(header.test_constant, map.expected_test_constant)) {
    return device_failure(fmt::format(
        "its test constant reads {}, not {}; correct word_order, byte_order or test_constant in the device file",
        header.test_constant, map.expected_test_constant));
  }
  if (header.record_size != map.record_size) {
    return device_failure(fmt::format("its records have {} registers, not {}; correct record_size in the device file",
                                      header.record_size, map.record_size));
  }
  if (header.capacity == 0) return device_failure("its ring has no records; set ring_capacity in the device file");
  const std::uint64_t end = map.records + std::uint64_t{header.capacity} * map.record_size;
  if (end <= kRegisters) return {};
  return device_failure(
      fmt::format("its ring of {} records ends at register {}, beyond 65535; correct ring_capacity in the device file",
                  header.capacity, end - 1));
}

std::string order_settings(const CmmMap& map, const RegisterOrder& order) {
  std::string text;
  if (order.words != map.word_order) text += fmt::format("word_order = \"{}\"", name_of(kWordOrders, order.words));
  if (order.bytes == map.byte_order) return text;
  return text + fmt::format("{}byte_order = \"{}\"", text.empty() ? "" : " and ", name_of(kByteOrders, order.bytes));
}

Failure check_map(const CmmMap& map) {
  if (!map.newest.present) return bad_input("newest is missing; without it new records cannot be seen");
  if (!map.sequence.present)
    return bad_input("sequence is missing; without it a late reply cannot be told from a record");
  for (const NumberField& axis : map.position) {
    if (!axis.present) return bad_input("x, y or z is missing; a point needs all three");
  }
  const bool directed = map.direction[0].present;
  if (map.direction[1].present != directed || map.direction[2].present != directed) {
    return bad_input("i, j and k must be all there or all absent");
  }
  if (!map.capacity.present && map.ring_capacity == 0)
    return bad_input("ring_capacity is missing; the device does not tell it");
  if (Failure fault = check_header_place(map)) return fault;
  return check_record_fields(map);
}

}  // namespace bladefit
