#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/fit/fit_mode.hpp"
#include "core/fit/pose.hpp"
#include "core/inspection/blade_verdict.hpp"
#include "core/inspection/decision.hpp"
#include "core/inspection/shaft_axis.hpp"
#include "core/localizer.hpp"
#include "firmware_bridge/host/journal/journal_format.hpp"
#include "firmware_bridge/host/threads/stream_losses.hpp"
#include "tools/files/rows.hpp"
#include "tools/results/blade_drawing.hpp"
#include "tools/results/report_record.hpp"
#include "tools/results/verdict_reason.hpp"

namespace bladefit {

/// One point with its final verdict. Lengths in mm.
struct ResultPoint {
  std::uint32_t sequence = 0;        ///< from 1; the index in result.json is one less
  std::array<double, 3> position{};  ///< as measured, machine frame
  std::uint32_t patch = 0;
  double u = 0, v = 0;  ///< of the foot, 0..1
  FootKind kind = FootKind::interior;
  Region region = Region::rest;
  std::uint8_t zone = 0;   ///< of Result::zones, from 1; 0: none of them
  double distance = 0;     ///< > 0: excess material
  double tolerance = 0;    ///< |distance| allowed on the side of the distance; infinity = not judged
  double uncertainty = 0;  ///< standard uncertainty of the distance that comes from the pose
  double expanded = 0;     ///< expanded uncertainty of the distance, the probe's part included where it is known
  double before = 0;       ///< distance before the fit, at C = I, t = 0: a best fit hides errors
  PointState state = PointState::pending;
  Action action = Action::none;
  LeftOut left_out = LeftOut::none;  ///< why it is rejected; none too where a file does not say
  double beyond = 0;                 ///< how far it lies beyond an outer edge of the design, along the surface
  std::optional<Vec3> foot;  ///< on the design; nothing in a session that was read back, whose files do not hold it
};

/// A part of the blade with tolerances of its own [mm].
struct ResultZone {
  std::string name, where;
  Region region = Region::rest;
  double plus = 0, minus = 0;  ///< excess and missing material that are allowed; infinity = not judged
};

/// Distances of the points that count in the fit [mm]. Before: at C = I, t = 0, whatever the start pose.
struct FitDistances {
  std::uint32_t count = 0;
  double rms_before = 0, rms_after = 0, max_after = 0;
};
struct BladeDistances : FitDistances {
  double max_before = 0;
};
struct RegionDistances : FitDistances {
  double tolerance = std::numeric_limits<double>::infinity();  ///< that of the fit; infinity = not judged
};

/// A point that does not belong to the others: a chip under the probe, a wrong touch, or a defect of the blade.
struct Outlier {
  std::uint32_t sequence = 0;
  double distance = 0;     ///< [mm]
  double studentized = 0;  ///< distance / its standard deviation, signed
};
struct Outliers {
  std::vector<Outlier> points;  ///< the largest first
  double limit = 0;             ///< of |studentized|, beyond which a point is an outlier; 0 = none was sought
  double scale = 0;             ///< robust standard deviation of a distance of weight 1 [mm]
};

/// The robust loss that a least-squares fit used.
struct LossUsed {
  std::string name;
  double scale = 0;  ///< standard deviation of good points [mm]
};

/// The one word on the blade, and what stands behind it.
struct ResultVerdict {
  BladeState state = BladeState::not_decided;
  std::vector<VerdictReason> reasons;
  std::vector<SequenceRange> lost;  ///< records of the device that never arrived
  DecisionRule decision = DecisionRule::simple;
  double coverage_factor = 2;

  [[nodiscard]] Reasons codes() const;
  /// False where the fit itself is in doubt: then no point is judged.
  [[nodiscard]] bool fit_decided() const { return !codes().doubt_the_fit(); }
};

/// What only the fit itself knows: the files of a session do not hold it.
struct FitDetails {
  FitMode mode = FitMode::least_squares;
  double ratio = 1;                   ///< of the tolerances, rest to leading edge, in min_tolerance
  double leading_edge_tolerance = 0;  ///< by which points were judged [mm]: in min_tolerance not that which was found
  double rest_tolerance = 0;
  std::uint32_t determined = 0;  ///< degrees of freedom that the points determine
  std::uint32_t free = 6;        ///< degrees of freedom that are not locked
  std::uint32_t unproven = 0;    ///< feet that could not be proven the nearest
  FitEnd ended = FitEnd::none;   ///< why it has not converged
  std::uint32_t held_feet = 0;   ///< points whose foot the mode's program kept from turning from its probe
  double stationarity = 0;       ///< of the optimum's Karush-Kuhn-Tucker conditions, relative
};

/// A fit and its points: what the summary, result.json, verdicts.csv and every report are made from. `localize` and
/// `run` make it from a fit, `report` reads it back from the files of a session. Lengths in mm; a format that writes
/// them in `units` divides by mm_per_unit.
struct Result {
  std::string name;                         ///< of the session's folder, or of the file of points
  std::optional<SessionIdentity> identity;  ///< design and settings that a session's recording is bound to
  std::string text;                         ///< result.json to the letter, where this was read from one

  ResultVerdict verdict;
  std::string status, mode;  ///< in the words of result.json
  std::string units = "mm";  ///< mm, in, cm or m
  double mm_per_unit = 1.0;
  Pose pose;                       ///< machine -> design
  std::optional<Mat6> covariance;  ///< of (w, dt) [rad, mm]; nothing where undetermined
  BladeDistances all;
  RegionDistances leading_edge, rest;
  std::vector<ParameterBox> boxes;  ///< of the leading-edge region
  std::vector<ResultZone> zones;    ///< by falling precedence; with zones the regions' tolerances are their tightest
  double rest_outside = std::numeric_limits<double>::infinity();  ///< |distance| allowed outside of all zones [mm]
  double tolerance_factor = 0;                                    ///< optimum of the mode; 0 = it has none
  Certificate certificate;                                        ///< of that optimum
  std::uint32_t further_starts = 0;  ///< from how many other poses the optimum was sought again,
  std::uint32_t same_optimum = 0;    ///< and how many of these led to the same one
  ShaftAxis axis;                    ///< from which radii are measured
  double tip_radius = 0;             ///< R of r/R; 0 = not known
  std::vector<std::string> notes;    ///< what the user should know of how the pose was found, a line each
  std::vector<std::string> locked;   ///< degrees of freedom that kept their start value: tx, ry ...
  std::optional<LossUsed> loss;
  Outliers outliers;
  std::vector<std::uint32_t> judged_otherwise;  ///< points that a robust fit finds in instead of out, or the reverse
  Rows<ResultPoint> points;                     ///< rising sequence
  std::optional<FitDetails> details;

  std::optional<ReportRecord> record;                         ///< nothing where no file says
  std::string written;                                        ///< when the report is made, as utc_now() writes it
  std::vector<std::pair<std::string, std::string>> settings;  ///< of the fit, names with values
  std::optional<BladeDrawing> drawing;                        ///< nothing where the design is not at hand

  /// A length of this result in the units in which it is written.
  [[nodiscard]] double in_units(double length) const { return length / mm_per_unit; }
};

/// Exit code of the verdict: 0 in tolerance or nothing to judge, 1 out of tolerance, 4 not decided or nothing to judge
/// by a fit that is itself not decided.
[[nodiscard]] int exit_code_of(const Result& result);

}  // namespace bladefit
