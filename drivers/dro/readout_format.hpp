#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "drivers/dro/dro_line.hpp"

namespace bladefit {

/// The numbers of a point as a read-out has printed them: x, y, z.
using DroPoint = std::array<DroNumber, 3>;

/// What lines came to.
struct DroOutcome {
  std::vector<DroPoint> points;     ///< good, in their order
  std::vector<std::string> losses;  ///< points that were probed and cannot be read: why, in words
  std::vector<std::string> faults;  ///< lines that were no whole points of this session
};

/// How a read-out prints its numbers, learned from its points, so that one that has lost a character is seen: another
/// number of decimals, other marks, fewer digits or characters than those to which zeros or blanks fill numbers up.
class ReadoutFormat {
 public:
  explicit ReadoutFormat(const DroSettings& settings) : settings_(settings) {}

  /// Takes a point: it becomes good or a loss. The very first one waits for the next where its own numbers differ in
  /// their decimals, since then either the read-out prints so, or it has lost a character.
  void take(const DroPoint& point, DroOutcome& outcome);

  /// A first point waits for the next.
  [[nodiscard]] bool waits() const { return waiting_.has_value(); }

 private:
  [[nodiscard]] std::string difference(const DroPoint& reference, const DroPoint& point) const;
  [[nodiscard]] std::string shortness(const DroPoint& point) const;
  void accept(const DroPoint& point, DroOutcome& outcome);

  const DroSettings& settings_;
  std::optional<DroPoint> reference_;  ///< the first good point
  std::optional<DroPoint> waiting_;
  DroPoint last_{};  ///< the newest good point
  /// Least of each axis, where zeros or blanks were seen to fill numbers up to it; 0 = not so far.
  std::array<std::size_t, 3> least_digits_{}, least_width_{};
};

}  // namespace bladefit
