#pragma once
#include <algorithm>
#include <vector>

#include "core/localizer.hpp"
#include "tools/files/rows.hpp"

namespace bladefit {

/// A point with its final verdict.
struct JudgedPoint {
  ProbePoint point;
  Verdict verdict;
};

/// The same with its distance before the fit, at C = I, t = 0 [mm].
struct FittedPoint {
  ProbePoint point;
  Verdict verdict;
  double before = 0;
};

/// Of more points than this some stand for all in what is said of them as a whole, and in the robust fit, evenly taken:
/// that keeps memory and time of a long session within bounds.
inline constexpr std::size_t kMostLookedAt = 16384;

/// At most `count` of the rows, evenly spread over their order.
template <typename Row>
[[nodiscard]] std::vector<Row> some_of(const Rows<Row>& rows, std::size_t count) {
  std::vector<Row> out;
  const std::size_t taken = std::min(rows.size(), count);
  out.reserve(taken);
  for (std::size_t k = 0; k < taken; ++k) out.push_back(rows[k * rows.size() / taken]);
  return out;
}

}  // namespace bladefit
