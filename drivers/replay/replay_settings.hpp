#pragma once
#include <string>

#include "drivers/replay/points_csv.hpp"

namespace bladefit {

/// A recording: a CSV file of points.
struct ReplaySettings {
  std::string file;
  PointsFormat format;
};

}  // namespace bladefit
