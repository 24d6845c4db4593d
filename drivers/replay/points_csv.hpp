#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/probe_point.hpp"
#include "drivers/source/failure.hpp"

namespace bladefit {

/// Points of a CSV file, or why there are none.
struct PointsFile {
  std::vector<ProbePoint> points;  ///< [mm], numbered from 1 in the order of the file; empty where `error` is set
  bool has_approach = false;       ///< the file has columns i,j,k
  bool has_path = false;           ///< the file has a column path
  Failure error;                   ///< bad_input: one line with file, line, column and the fix
};

/// What becomes of directions that are not of length 1 to the last digit.
enum class Directions {
  normalised,
  as_written,  ///< for a simulated machine, which tells what its file says
};

/// Reads points from `text`, the content of the file `name` (used in errors only).
/// The first line that is neither empty nor a comment (#) names the columns, in any order: x,y,z, optionally i,j,k
/// (unit vector from the probe to the material, 0,0,0 = unknown), path (0..65535) and weight (of the squared distance
/// in the least-squares objective, above 0; 1 where it is not given). Lengths are multiplied by
/// `mm_per_unit`. Numbers have a decimal point whatever the locale. Directions whose length is 1 within 1e-3 are
/// normalised where `directions` says so, others are errors. Cost: linear in the size.
[[nodiscard]] PointsFile parse_points_csv(std::string_view text, std::string_view name, double mm_per_unit,
                                          Directions directions = Directions::normalised);

/// The same for the file at `path`, which may have up to 1 GiB.
[[nodiscard]] PointsFile read_points_csv(const std::string& path, double mm_per_unit,
                                         Directions directions = Directions::normalised);

}  // namespace bladefit
