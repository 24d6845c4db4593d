#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/fit/pose.hpp"
#include "core/inspection/verdict.hpp"
#include "firmware_bridge/host/journal/journal_format.hpp"

namespace bladefit {

inline constexpr const char* kResultFile = "result.json";
inline constexpr const char* kVerdictsFile = "verdicts.csv";
inline constexpr const char* kJournalFile = "journal.bin";

/// One point with its last verdict, lengths in the report's unit.
struct ReportPoint {
  std::uint32_t sequence = 0;
  std::array<double, 3> position{};  ///< as measured, machine frame
  std::uint32_t patch = 0;
  double u = 0, v = 0;  ///< of the foot, 0..1
  FootKind kind = FootKind::interior;
  Region region = Region::rest;
  double distance = 0;     ///< > 0: excess material
  double tolerance = 0;    ///< |distance| allowed; infinity = not judged
  double uncertainty = 0;  ///< standard uncertainty of the distance that comes from the pose
  PointState state = PointState::pending;
  Action action = Action::none;
};

/// The points of one region that count in the fit, lengths in the report's unit.
struct ReportRegion {
  std::uint32_t count = 0;
  double rms_before = 0, rms_after = 0, max_abs_after = 0;
  double tolerance = 0;  ///< infinity = not judged
};

/// What result.json says besides its points, lengths in its own unit.
struct ReportedFit {
  std::string status, mode;
  std::string units;         ///< mm or in
  double mm_per_unit = 1.0;  ///< 1 or 25.4
  Pose pose;                 ///< machine -> design, translation in `units`
  EulerAngles euler;
  std::optional<std::array<double, 6>> standard_uncertainty;  ///< of (w, dt) [rad, units]; none where undetermined
  std::uint32_t count = 0;                                    ///< points that count in the fit
  double rms_before = 0, rms_after = 0, max_abs_before = 0, max_abs_after = 0;
  ReportRegion leading_edge, rest;
  std::vector<ParameterBox> boxes;  ///< of the leading-edge region; empty where the file does not tell them
};

/// A session as its folder tells of it.
struct SessionReport {
  std::string name;          ///< of the folder, without the path to it
  std::string result_text;   ///< result.json to the letter
  SessionIdentity identity;  ///< design and settings that the recording is bound to
  ReportedFit fit;
  std::vector<ReportPoint> points;  ///< rising sequence
};

/// Reads result.json and verdicts.csv of a session folder and checks that they are whole, belong together and tell of
/// every point in the journal. Throws ToolError (bad_input) that names the file and the mend, also where the session
/// still runs or was cut off.
[[nodiscard]] SessionReport read_session(const std::string& directory);

}  // namespace bladefit
