#pragma once
#include <optional>
#include <string>

namespace bladefit {

/// A recording: a CSV file of points.
struct ReplaySettings {
  std::string file;
  std::optional<double> mm_per_unit;  ///< of the file's lengths; where nobody has said it they are mm
};

}  // namespace bladefit
