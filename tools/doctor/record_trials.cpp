#include "tools/doctor/record_trials.hpp"

#include <modbus.h>

#include <algorithm>
#include <cmath>

#include "drivers/modbus/cmm_record.hpp"

namespace bladefit {
namespace {

constexpr std::uint32_t kMostRecords = 48;
/// [mm] Coordinates of no machine, not even in another unit, are beyond these.
constexpr double kLeastCoordinate = 1e-9, kMostCoordinate = 1e9;
/// A record may be written while it is read.
constexpr double kGoodShare = 0.75;

bool is_plausible(const ProbePoint& point) {
  return std::ranges::all_of(point.position, [](double x) {
    return x == 0 || (std::abs(x) >= kLeastCoordinate && std::abs(x) <= kMostCoordinate);
  });
}

/// Neighbours in the ring that one read brings.
struct Stretch {
  std::uint32_t first = 0, count = 0;
};

/// The newest records, the older half of a ring left out: it is being overwritten.
std::vector<Stretch> stretches(const CmmHeader& header, const CmmMap& map, int batch) {
  const std::uint32_t wanted = std::min({header.newest, std::max<std::uint32_t>(header.capacity / 2, 1), kMostRecords});
  const auto most =
      std::min<std::uint32_t>(static_cast<std::uint32_t>(batch), MODBUS_MAX_READ_REGISTERS / map.record_size);
  std::vector<Stretch> found;
  for (std::uint32_t left = wanted; left > 0;) {
    const std::uint32_t first = header.newest - left + 1;
    const std::uint32_t to_end = header.capacity - (first - 1) % header.capacity;
    const std::uint32_t count = std::min({left, most, to_end});
    found.push_back({first, count});
    left -= count;
  }
  return found;
}

}  // namespace

bool RecordTrial::makes_sense() const {
  const auto good = std::ranges::count_if(points, is_plausible);
  return asked > 0 && good > 0 && static_cast<double>(good) >= kGoodShare * static_cast<double>(asked);
}

RecordTrial read_records(RegisterReader& reader, const CmmMap& map, const HeaderTrial& trial, const MapChange& change,
                         int batch) {
  RecordTrial records;
  records.change = change;
  records.map = map;
  records.header = trial.header;
  for (const Stretch& stretch : stretches(trial.header, map, batch)) {
    const std::uint32_t slot = (stretch.first - 1) % trial.header.capacity;
    const auto address = static_cast<std::uint16_t>(map.records + slot * map.record_size);
    const RegisterReply& reply =
        reader.read(map.table, address, static_cast<std::uint16_t>(stretch.count * map.record_size));
    for (std::uint32_t index = 0; index < stretch.count; ++index) {
      ++records.asked;
      ProbePoint point;
      const std::size_t size = map.record_size;
      const Failure failure = reply.good() ? decode_record(std::span(reply.registers).subspan(index * size, size), map,
                                                           stretch.first + index, point)
                                           : device_failure(reply.fault);
      if (!failure) records.points.push_back(point);
      if (failure && records.fault.empty()) records.fault = failure.message;
    }
    RegisterReply newest = reply;
    const std::size_t before = std::size_t{stretch.count - 1} * map.record_size;
    if (newest.good())
      newest.registers.erase(newest.registers.begin(), newest.registers.begin() + static_cast<std::ptrdiff_t>(before));
    records.raw = raw_text(newest, map.table, static_cast<int>(address + before + map.address_base));
    if (!reply.good()) break;
  }
  return records;
}

}  // namespace bladefit
