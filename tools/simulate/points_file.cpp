#include "tools/simulate/points_file.hpp"

#include "drivers/replay/points_csv.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit::simulate {

std::vector<MachinePoint> read_points_file(const std::string& path, double mm_per_unit) {
  const PointsFile file = read_points_csv(path, mm_per_unit, Directions::as_written);
  if (file.error) throw ToolError(file.error);
  std::vector<MachinePoint> points;
  points.reserve(file.points.size());
  for (const ProbePoint& point : file.points) points.push_back({point.position, point.approach, point.path});
  return points;
}

}  // namespace bladefit::simulate
