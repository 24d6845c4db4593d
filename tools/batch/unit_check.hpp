#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tools/batch/fit_options.hpp"
#include "tools/search/pose_search.hpp"

namespace bladefit {

/// A motion that points need besides a rigid one to fit a design.
struct UnitFound {
  double factor = 1;  ///< by which the points are too large; below 1: too small
  bool fits = false;  ///< whether they fit when they are divided by it; false: their size alone says so
};

/// Largest distance of two points, without the tenth of them that is farthest from the middle: gross errors.
[[nodiscard]] double trimmed_extent(const std::vector<ProbePoint>& points);

/// True where the points span more than the design can: they cannot belong to it as they are. Cost: linear.
[[nodiscard]] bool larger_than_design(const Surface& surface, const std::vector<ProbePoint>& points);

/// True where they span so little of it that their unit may be a larger one.
[[nodiscard]] bool much_smaller_than_design(const Surface& surface, const std::vector<ProbePoint>& points);

/// Tries the factors between usual units that bring the points to the size of the design; `best_mm` is the typical
/// distance of the best fit as they are (infinite where there is none). Nothing where no factor fits far better. Cost:
/// a search each, at most three.
[[nodiscard]] std::optional<UnitFound> find_unit(const PoseSearch& search, const std::vector<ProbePoint>& points,
                                                 double best_mm);

/// One sentence on points in another unit, which ends with the way out. `unit` is the one they were taken in.
[[nodiscard]] std::string unit_sentence(const UnitFound& found, Unit unit);

}  // namespace bladefit
