#pragma once
#include <string>
#include <vector>

#include "config/fit_option.hpp"
#include "core/geometry/surface/design_image.hpp"
#include "core/inspection/shaft_axis.hpp"
#include "core/localizer.hpp"
#include "drivers/replay/points_csv.hpp"
#include "tools/batch/first_feet.hpp"
#include "tools/design/load_design.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {

/// How a zone of the tolerance map is called, and where it is as it was given.
struct PlannedZone {
  std::string name, where;
};

/// A fit ready to run.
struct FitPlan {
  std::string units = "mm";  ///< of lengths on the command line and in results
  double mm_per_unit = 1.0;
  PointsFormat points;  ///< of the points file
  LocalizerConfig localizer;
  std::vector<PlannedZone> zones;            ///< of localizer.tolerance, in their order
  FootStarts starts = FootStarts::searched;  ///< of a batch fit
  ShaftAxis axis;                            ///< of the design [mm]
  double tip_radius_mm = 0;                  ///< R of r/R; 0 = the greatest distance of the surface from the axis
  bool search_start = false;                 ///< the start pose is to be searched from the points
  std::string note;                          ///< lines the user should read; empty = none
};

/// Names of the degrees of freedom in a set of bits of motion_lock.hpp: tx, ry ...
[[nodiscard]] std::vector<std::string> names_of_locked(std::uint8_t locked);

/// The file of start pairs; empty = none is given.
[[nodiscard]] std::string start_file_of(const FitSettings& settings);

/// Which faces of a design are used, and which side of them is away from the material.
[[nodiscard]] DesignChoice design_choice_of(const FitSettings& settings);

/// Turns the settings to a configuration in mm and checks it by check_config(). Throws ToolError (bad_input) that names
/// the option and the fix.
[[nodiscard]] FitPlan plan_fit(const FitSettings& settings, const DesignImage& design);

}  // namespace bladefit
