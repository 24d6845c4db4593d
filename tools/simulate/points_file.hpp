#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/replay/points_csv.hpp"

namespace bladefit::simulate {

/// One touch as the machine knows it.
struct MachinePoint {
  std::array<double, 3> position_mm{};
  std::array<double, 3> direction{};  ///< unit vector from the probe to the material; all 0 = unknown
  std::uint16_t path = 0;             ///< scan line; 0 = unknown
};

/// Reads the points that the machine touches, by the reader of recordings: the user's CSV is one format. A machine does
/// not know weights, so those of the file are not served, and tells its directions as they are written.
/// Throws ToolError (bad_input) that names file, line and the fix.
[[nodiscard]] std::vector<MachinePoint> read_points_file(const std::string& path, const PointsFormat& format);

}  // namespace bladefit::simulate
