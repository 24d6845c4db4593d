#include "drivers/dro/readout_format.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace bladefit {
namespace {

constexpr const char* kLostCharacter = "a character may be lost";

bool without_decimal_marks(const DroPoint& point) {
  return std::ranges::none_of(point, [](const DroNumber& number) { return number.marked; });
}

/// Every number has as many decimals, and as many whole digits where zeros fill them up.
bool is_uniform(const DroPoint& point) {
  const bool padded = std::ranges::any_of(point, [](const DroNumber& number) { return number.zero_padded; });
  return std::ranges::all_of(point, [&](const DroNumber& number) {
    return number.decimals == point[0].decimals && (!padded || number.whole_digits == point[0].whole_digits);
  });
}

}  // namespace

/// Empty: both are printed alike.
std::string ReadoutFormat::difference(const DroPoint& reference, const DroPoint& point) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const DroNumber &before = reference[axis], &now = point[axis];
    if (before.marks != now.marks) {
      return fmt::format("'{}' stands behind {}, not '{}' as before: its units may have been switched, or {}",
                         now.marks, axis_letter(axis), before.marks, kLostCharacter);
    }
    if (settings_.fixed_decimals && before.decimals != now.decimals) {
      return fmt::format("{} has {} decimals, not {} as before: {} (fixed_decimals = false: zeros may be dropped)",
                         axis_letter(axis), now.decimals, before.decimals, kLostCharacter);
    }
  }
  return {};
}

/// Empty: no number is shorter than those before it, where they have a fixed width.
std::string ReadoutFormat::shortness(const DroPoint& point) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const DroNumber& now = point[axis];
    zero_padded_ |= now.zero_padded;
    blank_padded_ |= reference_ && now.width == widest_[axis].width && now.pad != widest_[axis].pad;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const DroNumber &now = point[axis], &widest = widest_[axis];
    const bool fewer_digits = zero_padded_ && now.whole_digits < widest.whole_digits;
    const bool narrower = blank_padded_ && now.width < widest.width;
    if (!fewer_digits && !narrower) continue;
    return fmt::format("{} takes fewer characters than before: {}", axis_letter(axis), kLostCharacter);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    DroNumber& widest = widest_[axis];
    const std::size_t digits = std::max(widest.whole_digits, point[axis].whole_digits);
    if (point[axis].width >= widest.width || !blank_padded_) widest = point[axis];
    widest.whole_digits = digits;
  }
  return {};
}

void ReadoutFormat::settle_waiting(const DroPoint& point, DroOutcome& outcome) {
  const DroPoint first = *std::exchange(waiting_, std::nullopt);
  const std::string other = difference(point, first);
  if (!other.empty()) return outcome.losses.push_back(other);
  reference_ = first;
  static_cast<void>(shortness(first));
  outcome.points.push_back(first);
}

void ReadoutFormat::take(const DroPoint& point, DroOutcome& outcome) {
  if (waiting_) settle_waiting(point, outcome);
  if (settings_.fixed_decimals && !settings_.scale && without_decimal_marks(point)) {
    return outcome.losses.push_back(
        "no number has a decimal mark (set scale to the value of one count, such as 0.001)");
  }
  if (!reference_ && settings_.fixed_decimals && !is_uniform(point)) {
    waiting_ = point;
    return outcome.faults.push_back("its numbers differ in their digits: it waits until the next point has shown why");
  }
  const std::string other = reference_ ? difference(*reference_, point) : std::string();
  const std::string shorter = other.empty() ? shortness(point) : std::string();
  if (!reference_) reference_ = point;
  if (other.empty() && shorter.empty()) return outcome.points.push_back(point);
  outcome.losses.push_back(other.empty() ? shorter : other);
}

}  // namespace bladefit
