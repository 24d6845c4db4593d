#include "drivers/dro/readout_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace bladefit {
namespace {

constexpr const char* kLostCharacter = "a character may be lost";

bool without_decimal_marks(const DroPoint& point) {
  return std::ranges::none_of(point, [](const DroNumber& number) { return number.marked; });
}

/// Digits to which zeros fill up the whole part of a number; 0 = of none.
std::size_t padded_digits(const DroPoint& point) {
  std::size_t digits = 0;
  for (const DroNumber& number : point) {
    if (number.zero_padded) digits = std::max(digits, number.whole_digits);
  }
  return digits;
}

/// Every number has as many decimals, and as many whole digits as zeros fill up one of them.
bool is_uniform(const DroPoint& point) {
  return std::ranges::all_of(point, [&](const DroNumber& number) {
    return number.decimals == point[0].decimals && number.whole_digits >= padded_digits(point);
  });
}

}  // namespace

/// Empty: both are printed alike.
std::string ReadoutFormat::difference(const DroPoint& reference, const DroPoint& point) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const DroNumber &before = reference[axis], &now = point[axis];
    if (before.marks != now.marks) {
      return fmt::format(
          "the marks behind {} are \"{}\", not \"{}\" as before: its units may have been switched, or {}",
          axis_letter(axis), now.marks, before.marks, kLostCharacter);
    }
    if (settings_.fixed_decimals && before.decimals != now.decimals) {
      return fmt::format("{} has {} decimals, not {} as before: {} (fixed_decimals = false: zeros may be dropped)",
                         axis_letter(axis), now.decimals, before.decimals, kLostCharacter);
    }
  }
  return {};
}

/// Empty: no number is shorter than zeros or blanks would have filled it up.
std::string ReadoutFormat::shortness(const DroPoint& point) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (point[axis].whole_digits >= least_digits_[axis] && point[axis].width >= least_width_[axis]) continue;
    return fmt::format("{} takes fewer characters than before: {}", axis_letter(axis), kLostCharacter);
  }
  return {};
}

/// Takes a good point and learns from it. A 0 in front of other digits, or as wide a number behind more blanks, shows
/// to how many characters numbers are filled up.
void ReadoutFormat::accept(const DroPoint& point, DroOutcome& outcome) {
  const bool alike = is_uniform(point);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const DroNumber& number = point[axis];
    const std::size_t digits = alike ? padded_digits(point) : number.zero_padded ? number.whole_digits : 0;
    least_digits_[axis] = std::max(least_digits_[axis], digits);
    const bool filled_up = reference_ && number.width == last_[axis].width && number.pad != last_[axis].pad;
    if (filled_up) least_width_[axis] = number.width;
  }
  if (!reference_) reference_ = point;
  last_ = point;
  outcome.points.push_back(point);
}

void ReadoutFormat::take(const DroPoint& point, DroOutcome& outcome) {
  if (const std::optional<DroPoint> first = std::exchange(waiting_, std::nullopt)) {
    const std::string other = difference(point, *first);
    if (other.empty()) {
      accept(*first, outcome);
    } else {
      outcome.losses.push_back(other);
    }
  }
  if (settings_.fixed_decimals && !settings_.scale && without_decimal_marks(point)) {
    return outcome.losses.push_back(
        "no number has a decimal mark (set scale to the value of one count, such as 0.001)");
  }
  if (!reference_ && settings_.fixed_decimals && !is_uniform(point)) {
    waiting_ = point;
    return outcome.faults.push_back("its numbers differ in their digits: it waits until the next point has shown why");
  }
  std::string fault = reference_ ? difference(*reference_, point) : std::string();
  if (fault.empty()) fault = shortness(point);
  if (fault.empty()) return accept(point, outcome);
  outcome.losses.push_back(std::move(fault));
}

}  // namespace bladefit
