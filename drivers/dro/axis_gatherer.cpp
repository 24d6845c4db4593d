#include "drivers/dro/axis_gatherer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace bladefit {
namespace {

std::size_t axis_of(char letter) { return static_cast<std::size_t>(letter - 'x'); }

}  // namespace

void AxisGatherer::restart(bool from_silence) {
  held_.clear();
  group_.clear();
  orphans_told_ = false;
  cut_by_link_ = !from_silence;
  if (settings_.order_given) first_axis_ = axis_of(settings_.order[0]);
}

/// What has come of a point is of no use.
void AxisGatherer::give_up(DroOutcome& outcome, const std::string& why) {
  (cut_by_link_ ? outcome.faults : outcome.losses).push_back(why);
  held_.clear();
  group_.clear();
}

void AxisGatherer::take(const DroLine& line, Time now, std::vector<DroPoint>& points, DroOutcome& outcome) {
  silence(now, points, outcome);
  if (line.count() == 3) {
    take_point(line, points, outcome);
  } else if (layout_ == DroLayout::whole_points) {
    outcome.losses.push_back(fmt::format("{} stands alone in its line, unlike before: the rest of the line is lost",
                                         axis_letter(line.first_axis())));
  } else {
    const std::size_t axis = line.first_axis();
    hold({axis, *line.axes[axis]}, now, points, outcome);
  }
  last_line_ = now;
}

void AxisGatherer::line_lost() {
  if (!first_axis_) cut_by_link_ = true;
  if (!held_.empty()) held_.emplace_back();
  group_.clear();
  orphans_told_ = true;
}

void AxisGatherer::take_point(const DroLine& line, std::vector<DroPoint>& points, DroOutcome& outcome) {
  if (layout_ == DroLayout::single_axes) return outcome.losses.push_back("three axes stand in one line, unlike before");
  if (waits()) give_up(outcome, "one axis stood alone in its line: the rest of the line is lost");
  layout_ = DroLayout::whole_points;
  cut_by_link_ = false;
  points.push_back({*line.axes[0], *line.axes[1], *line.axes[2]});
}

void AxisGatherer::hold(AxisLine line, Time now, std::vector<DroPoint>& points, DroOutcome& outcome) {
  const bool fits = held_.empty() && !cut_by_link_ && line.axis == axis_of(settings_.order[0]);
  if (!first_axis_ && fits) first_axis_ = line.axis;
  const bool after_pause = !held_.empty() && now - last_line_ >= kPause;
  if (first_axis_ || (after_pause && begin_with(line.axis, points, outcome))) return take_axis(line, points, outcome);
  held_.push_back(std::move(line));
  if (held_.size() >= kMostHeld) give_up(outcome, "it is not clear with which axis a point begins (set order)");
}

/// A pause shows that points begin with `axis`. It is believed where the settings or the first line say the same.
bool AxisGatherer::begin_with(std::size_t axis, std::vector<DroPoint>& points, DroOutcome& outcome) {
  if (axis != axis_of(settings_.order[0]) && axis != held_.front().axis) return false;
  first_axis_ = axis;
  for (const AxisLine& line : std::exchange(held_, {})) take_axis(line, points, outcome);
  return true;
}

void AxisGatherer::take_axis(const AxisLine& line, std::vector<DroPoint>& points, DroOutcome& outcome) {
  if (line.axis == kUnreadable) return line_lost();
  const bool begins = line.axis == *first_axis_;
  const bool repeated = std::ranges::find(group_, line.axis, &AxisLine::axis) != group_.end();
  if (repeated) {
    give_up(outcome,
            fmt::format("{} came twice before its point was complete: a line is lost", axis_letter(line.axis)));
    orphans_told_ = true;
  }
  if (!begins && group_.empty()) {
    if (!orphans_told_) {
      give_up(outcome, fmt::format("{} came without {} before it: a line is lost", axis_letter(line.axis),
                                   axis_letter(*first_axis_)));
    }
    orphans_told_ = true;
    return;
  }
  if (begins) orphans_told_ = false;
  group_.push_back(line);
  if (group_.size() < 3) return;
  DroPoint point;
  for (const AxisLine& part : std::exchange(group_, {})) point[part.axis] = part.number;
  layout_ = DroLayout::single_axes;
  cut_by_link_ = false;
  points.push_back(point);
}

void AxisGatherer::silence(Time now, std::vector<DroPoint>& points, DroOutcome& outcome) {
  const auto quiet = now - last_line_;
  if (!held_.empty() && quiet >= kPause) {
    // The line before a pause is the last of its point: what followed its like begins one.
    const std::size_t last = held_.back().axis;
    const auto like =
        std::find_if(held_.begin(), held_.end() - 1, [&](const AxisLine& line) { return line.axis == last; });
    if (like != held_.end() - 1) static_cast<void>(begin_with((like + 1)->axis, points, outcome));
  }
  if (quiet < kPatience) return;
  if (!held_.empty()) give_up(outcome, "it is not clear with which axis a point begins (set order)");
  if (!group_.empty()) give_up(outcome, "a point came with fewer than three axes: a line is lost");
}

}  // namespace bladefit
