#pragma once
#include <string>
#include <vector>

#include "tools/doctor/header_trials.hpp"

namespace bladefit {

/// The newest records, read with one map.
struct RecordTrial {
  MapChange change;
  CmmMap map;  ///< with the change
  CmmHeader header;
  std::vector<ProbePoint> points;  ///< of the good ones
  std::size_t asked = 0;           ///< how many records there were to read
  std::string fault;               ///< of the first that was not good
  std::string raw;                 ///< the registers of the newest one

  /// Most records are good ones, with coordinates that a machine can have.
  [[nodiscard]] bool makes_sense() const;
};

/// Reads the newest records as the map of `trial` says.
[[nodiscard]] RecordTrial read_records(RegisterReader& reader, const CmmMap& map, const HeaderTrial& trial,
                                       const MapChange& change, int batch);

}  // namespace bladefit
