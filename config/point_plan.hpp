#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "drivers/source/failure.hpp"

namespace bladefit {

/// What a session is told of the points that will come: their number, or the file of those that will be probed.
struct PointPlan {
  std::uint32_t count = 0;  ///< 0: they are those of the file
  std::string file;         ///< CSV of points, - = standard input
};

/// A plan as on the command line: a whole number from 1 to 4294967295, or the name of a file. A number that counts no
/// points is no name either: such a file is named as ./7.5. Error: a line that names the text and the fix.
[[nodiscard]] Failure parse_point_plan(std::string_view text, PointPlan& plan);

}  // namespace bladefit
