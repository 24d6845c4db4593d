#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tools/batch/fit_options.hpp"
#include "tools/batch/rival_poses.hpp"
#include "tools/results/verdict_reason.hpp"
#include "tools/search/pose_search.hpp"

namespace bladefit {

/// What the checks of a fit found. A doubt leaves the blade undecided; a note only tells of how the pose was found.
struct Findings {
  std::vector<VerdictReason> doubts;
  std::vector<std::string> notes;
};

/// Where a fit is to start.
struct StartChoice {
  Pose pose;
  bool searched = false;  ///< found from the points, and not the one that was given
  bool hopeless = false;  ///< no pose was found at which the points fit: there is nothing to start from
  bool averted = false;   ///< the probing directions run out of the material: a fit cannot use them
  Findings findings;
};

/// Whether points, design and start belong together: units, mirrored points, points of another part, a start far off, a
/// pose that another blade fits as well. Each check is bounded; where points lie near to the design they cost some
/// milliseconds, else some searches for a pose of a few tenths of a second each.
class WorldChecks {
 public:
  /// All of them must outlive it.
  WorldChecks(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points);

  /// The start of a fit of all points: the given one where the points come to lie from there, else one that is
  /// searched.
  [[nodiscard]] StartChoice choose_start();

  /// A start from which the points fit far better than in a finished fit; nothing where there is none, or no need.
  [[nodiscard]] std::optional<StartChoice> better_start(const PoseFit& finished);

  /// What stands against a finished fit. `searched`: its start was searched, so that it prefers none of several poses.
  [[nodiscard]] Findings findings_of(const PoseFit& finished, bool searched);

 private:
  [[nodiscard]] std::optional<Pose> usable_start() const;
  [[nodiscard]] PoseFit weighed(const PoseFit& finished) const;
  void check_directions(StartChoice& choice) const;
  [[nodiscard]] StartChoice searched_start();
  [[nodiscard]] const std::vector<PoseFit>& found_poses();
  [[nodiscard]] const PoseSearch& search();
  [[nodiscard]] VerdictReason explain_misfit(double best_mm);
  [[nodiscard]] std::optional<VerdictReason> explain_misfit_in_frame(const PoseFit& fitted);
  [[nodiscard]] bool fits_mirrored(double best_mm);
  void tell_rivals(const PoseFit& fitted, bool searched, Findings& findings);
  [[nodiscard]] bool moved_far(const Pose& pose) const;
  [[nodiscard]] std::string moved_by(const Pose& pose) const;

  const DesignImage& design_;
  const FitPlan& plan_;
  const std::vector<ProbePoint>& points_;
  double scale_mm_;  ///< against which distances are weighed
  std::optional<PoseSearch> search_;
  std::optional<std::vector<PoseFit>> found_;
};

/// What stands against a fit that was made elsewhere and cannot begin again: verdicts[i] is that of points[i].
[[nodiscard]] Findings doubts_about(const DesignImage& design, const FitPlan& plan,
                                    const std::vector<ProbePoint>& points, const FitReport& report,
                                    const std::vector<Verdict>& verdicts);

}  // namespace bladefit
