#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tools/batch/fit_options.hpp"
#include "tools/design/load_design.hpp"
#include "tools/design/nurbs/nurbs_surface.hpp"

namespace bladefit {

/// One blade of the stand-in data, ready to be fitted.
struct StudyCase {
  std::string name;
  std::vector<NurbsSurface> surfaces;  ///< [mm]
  LoadedDesign loaded;                 ///< the memory under `design`
  DesignImage design;
  int outward = 1;
  FitPlan plan;  ///< least squares; its leading edge is that of the case, and points keep the region they have there
  std::map<std::string, std::filesystem::path> points;  ///< of each subset
};

/// Reads case.json and the design in `folder`. Throws ToolError, one line that names the file and the fix.
[[nodiscard]] StudyCase read_study_case(const std::filesystem::path& folder);

/// The points of a subset [mm]. Throws ToolError as read_study_case().
[[nodiscard]] std::vector<ProbePoint> read_subset_points(const StudyCase& study, const std::string& subset);

}  // namespace bladefit
