#pragma once
#include <string>

#include "core/fit/pose.hpp"
#include "drivers/replay/points_csv.hpp"

namespace bladefit {

/// A coarse start: where some measured points belong on the design.
struct StartPairs {
  Pose pose;  ///< brings the measured points nearest to their places, in the sum of squares
  std::size_t count = 0;
  double rms_mm = 0, worst_mm = 0;  ///< of what remains between them
  std::string worst_name;           ///< of the pair with the largest rest
  std::string note;                 ///< columns that are not used; empty = none
};

/// Reads a CSV file of pairs: a line of column names [name,]x,y,z,design_x,design_y,design_z in any order, then a pair
/// a line; lengths are in the unit that the file says, or that of `format`. The pose follows in closed form (Umeyama
/// 1991, without a scale). Throws ToolError (bad_input) that names file, line or column and the fix: fewer than 3
/// pairs, pairs in one line, pairs that do not fit each other.
[[nodiscard]] StartPairs read_start_pairs(const std::string& path, const PointsFormat& format);

}  // namespace bladefit
