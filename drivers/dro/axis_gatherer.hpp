#pragma once
#include <array>
#include <chrono>
#include <optional>
#include <vector>

#include "drivers/dro/readout_format.hpp"

namespace bladefit {

/// Makes points of the lines of a read-out: a line with three axes is one; lines with one axis are gathered, three a
/// point. A point begins with the first axis of the order: with that of the settings where they give one or the first
/// line fits it, else with the one that pauses show. No clock of its own.
class AxisGatherer {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kPause{300};      ///< silence that parts two points
  static constexpr std::chrono::milliseconds kPatience{2000};  ///< in which a point must be complete
  static constexpr std::size_t kMostHeld = 3000;               ///< lines that wait until the order is known
  static constexpr std::size_t kUnreadable = 3;                ///< in place of an axis: the line could not be read

  explicit AxisGatherer(const DroSettings& settings) : settings_(settings) { restart(true); }

  /// The link is new. `from_silence`: the line was silent when it was made, so that no point was cut by that.
  void restart(bool from_silence);

  /// Takes a line that came at `now`. Points go to `points`, what is lost to `outcome`.
  void take(const DroLine& line, Time now, std::vector<DroPoint>& points, DroOutcome& outcome);

  /// A line could not be read: the point that it was of cannot be complete. The caller tells of it.
  void line_lost();

  /// Nothing has come for the time from the last line until `now`.
  void silence(Time now, std::vector<DroPoint>& points, DroOutcome& outcome);

  /// Lines wait for others.
  [[nodiscard]] bool waits() const { return !held_.empty() || !group_.empty(); }

 private:
  struct AxisLine {
    std::size_t axis = kUnreadable;
    DroNumber number;
  };

  void take_point(const DroLine& line, std::vector<DroPoint>& points, DroOutcome& outcome);
  void take_axis(const AxisLine& line, std::vector<DroPoint>& points, DroOutcome& outcome);
  void hold(AxisLine line, Time now, std::vector<DroPoint>& points, DroOutcome& outcome);
  [[nodiscard]] bool begin_with(std::size_t axis, std::vector<DroPoint>& points, DroOutcome& outcome);
  void give_up(DroOutcome& outcome, const std::string& why);

  const DroSettings& settings_;
  DroLayout layout_ = DroLayout::open;  ///< what points have shown it to be
  std::optional<std::size_t> first_axis_;
  std::vector<AxisLine> held_;   ///< lines before the first axis is known
  std::vector<AxisLine> group_;  ///< lines of the point under way
  Time last_line_{};
  bool orphans_told_ = false;  ///< lines of a point without its first one have been told of
  bool cut_by_link_ = false;   ///< what comes before the first point may have begun before the link was made
};

}  // namespace bladefit
