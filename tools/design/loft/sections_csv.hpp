#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/text/units.hpp"

namespace bladefit {

/// One blade section: points along a cut of the blade, in the order in which they lie on it.
struct BladeSection {
  std::string name;              ///< as in the column `section`
  std::optional<double> radius;  ///< r/R, where the file gives it
  std::vector<Eigen::Vector3d> points;
  std::vector<std::size_t> lines;  ///< of the file, counted from 1; one a point, none of a table's
};

/// The sections of a blade in the order of the file, from root to tip or back.
struct BladeSections {
  std::string file;
  std::vector<BladeSection> sections;  ///< lengths in the unit of the file
  std::optional<Unit> unit;            ///< of the lengths, where the file says it
  std::string note;                    ///< columns that are not used; empty = none
};

/// Reads sections from `text`, the content of the file `name`. The first line that is neither empty nor a comment (#)
/// names the columns, in any order: section (any name), x, y, z, optionally index (rising inside a section) and
/// r_over_R (one value a section). Rows with the same section stand together; sections may have different numbers of
/// points. Throws ToolError naming the line, the column and the fix. Cost: linear in the size.
BladeSections parse_sections_csv(std::string_view text, const std::string& name);

/// The same for the file at `path`. Throws ToolError as read_text does as well.
BladeSections read_sections_csv(const std::string& path);

}  // namespace bladefit
