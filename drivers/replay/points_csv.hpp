#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/probe_point.hpp"
#include "drivers/source/failure.hpp"
#include "drivers/text/units.hpp"

namespace bladefit {

/// Points of a CSV file, or why there are none.
struct PointsFile {
  std::vector<ProbePoint> points;  ///< [mm], numbered from 1 in the order of the file; empty where `error` is set
  bool has_approach = false;       ///< the file has columns i,j,k
  bool has_path = false;           ///< the file has a column path
  Unit unit = Unit::mm;            ///< in which the file's lengths were taken
  std::vector<std::string>
      notes;      ///< what the user should know: columns that are not used, the unit that the file says
  Failure error;  ///< bad_input: one line with file, line, column and the fix
};

/// What becomes of directions that are not of length 1 to the last digit.
enum class Directions {
  normalised,
  as_written,  ///< for a simulated machine, which tells what its file says
};

/// How a file of points is to be read.
struct PointsFormat {
  Unit unit = Unit::mm;                 ///< of the lengths, where neither the user nor the file says it
  std::optional<Unit> given_unit = {};  ///< as the user says it: a file that says another is refused
  std::string columns = {};             ///< as check_point_columns() takes them; empty = the first line names them
  Directions directions = Directions::normalised;
};

/// Whether `columns` names the columns of a file of points: x,y,z, optionally i,j,k, path and weight, in any order, and
/// - for each column that is not used. The error is a phrase.
[[nodiscard]] Failure check_point_columns(std::string_view columns);

/// Reads points from `text`, the content of the file `name` (used in errors only): a CSV table, see read_csv_table(),
/// with the columns x,y,z, optionally i,j,k (unit vector from the probe to the material; 0,0,0 or empty = unknown),
/// path (0..65535) and weight (of the squared distance in the least-squares objective, 1e-9 to 1e9; 1 where it is
/// empty). Lengths are in the unit that the file says with the names (`x [mm]`), or that of `format`. Directions whose
/// length is 1 within 1e-3 are normalised where `format` says so, others are errors. Cost: linear in the size.
[[nodiscard]] PointsFile parse_points_csv(std::string_view text, std::string_view name, const PointsFormat& format);

/// The same for the file at `path`, which may have up to 128 MiB; - is standard input.
[[nodiscard]] PointsFile read_points_csv(const std::string& path, const PointsFormat& format);

}  // namespace bladefit
