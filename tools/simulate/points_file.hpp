#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace bladefit::simulate {

/// One touch as the machine knows it.
struct MachinePoint {
  std::array<double, 3> position_mm{};
  std::array<double, 3> direction{};  ///< unit vector from the probe to the material; all 0 = unknown
  std::uint16_t path = 0;             ///< scan line; 0 = unknown
};

/// Reads a points file: a header that names the columns x, y, z and, where known, i, j, k and path, in any order;
/// then one point a line. Positions are multiplied by `mm_per_unit`. Lines that start with # are skipped.
/// Throws ToolError (bad input) that names file, line and the fix.
[[nodiscard]] std::vector<MachinePoint> read_points_file(const std::string& path, double mm_per_unit);

}  // namespace bladefit::simulate
