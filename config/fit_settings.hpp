#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/fit_text.hpp"
#include "config/length.hpp"
#include "config/outward_option.hpp"
#include "config/zone_settings.hpp"
#include "core/fit/fit_mode.hpp"
#include "core/fit/loss.hpp"
#include "core/fit/point_policy.hpp"
#include "core/inspection/decision.hpp"
#include "drivers/source/failure.hpp"
#include "drivers/text/units.hpp"

namespace bladefit {

/// The fit as a file or the command line gives it, each value parsed and within its range. What is not set is left to
/// the caller, so that flags win over files. Lengths are in `units`, by default those of the design file. What each
/// option means, and its range, stand in the table of fit_option.cpp.
struct FitSettings {
  std::optional<FitMode> mode;
  std::optional<std::vector<EdgeZone>> leading_edge;  ///< at most ToleranceMap::kMaxBoxes
  std::optional<Vec3> leading_edge_near;              ///< a place by that of the ridges which is the leading edge
  std::optional<Rotation> rotation;                   ///< by which the leading edge is found
  std::optional<Length> tolerance;                    ///< |distance| allowed at the leading edge
  std::optional<Length> rest_tolerance;               ///< |distance| allowed elsewhere
  std::optional<double> ratio;                        ///< rest tolerance / leading-edge tolerance
  std::optional<double> transition;                   ///< width of the zone between them [patch parameter]
  std::optional<ParameterWindow> window;
  std::optional<OutwardChoice> outward;
  std::optional<std::vector<std::string>> face;  ///< faces of the design that are used; numbers, names, patterns
  std::optional<double> blade;                   ///< the one blade of a propeller that is used; a whole number
  std::optional<bool> allow_missing;             ///< faces that cannot be read are left out
  std::optional<Length> probe_radius;
  std::optional<Unit> units;
  std::optional<std::string> columns;  ///< of the points file, as check_point_columns() takes them
  std::optional<RegionPolicy> regions;
  std::optional<EdgePolicy> edges;
  std::optional<std::uint8_t> lock;  ///< bits of motion_lock.hpp, not all of them
  std::optional<Loss> loss;
  std::optional<Length> loss_scale;  ///< standard deviation of good points
  std::optional<std::string> start;  ///< file of point pairs that give the start pose, or kSearchStart
  std::optional<ShaftAxis> axis;     ///< its point in `units`
  std::optional<Length> tip_radius;  ///< R of r/R
  std::optional<bool> ignore_approach;
  std::optional<DecisionRule> decision;
  std::optional<Length> probe_uncertainty;  ///< standard uncertainty of a distance that comes from the probe
  std::optional<ProbeError> mpe;            ///< largest error of the machine, from its data sheet
  std::optional<double> coverage_factor;
  std::optional<double> least_points;  ///< judged points that each zone needs; a whole number
  /// Parts of the blade with tolerances of their own, by falling precedence; of the tables [[zone]] beside [fit].
  std::optional<std::vector<ZoneSettings>> zones;
  std::string zones_file;  ///< that they were read from, where it is one of its own
};

/// The word in place of a file of point pairs: the start pose is searched.
inline constexpr std::string_view kSearchStart = "search";

/// Reads the tables [fit] and [[zone]] of a TOML file such as config/fit.toml into `settings`. Relative paths are those
/// of the file's folder, made ready to be used from the working directory. Errors: unreadable file, TOML syntax,
/// unknown key, wrong type, out of range; then `settings` is as before.
[[nodiscard]] Failure load_fit(const std::string& path, FitSettings& settings);

}  // namespace bladefit
