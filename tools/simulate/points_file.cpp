#include "tools/simulate/points_file.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "tools/files/tool_error.hpp"

namespace bladefit::simulate {

std::vector<MachinePoint> read_points_file(const std::string& path, const PointsFormat& format) {
  PointsFormat as_written = format;
  as_written.directions = Directions::as_written;
  const PointsFile file = read_points_csv(path, as_written);
  if (file.error) throw ToolError(file.error);
  for (const std::string& note : file.notes) fmt::print(stderr, "simulate: {}\n", note);
  std::vector<MachinePoint> points;
  points.reserve(file.points.size());
  for (const ProbePoint& point : file.points) points.push_back({point.position, point.approach, point.path});
  return points;
}

}  // namespace bladefit::simulate
