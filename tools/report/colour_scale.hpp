#pragma once
#include <string>

#include "tools/results/result.hpp"

namespace bladefit {

/// Colours of signed distances: blue where material is missing, white at the design, orange where there is too much.
/// The two ends differ for every common kind of colour vision.
struct ColourScale {
  double limit = 1.0;  ///< |distance| from which on the colour is full [units of the result], > 0

  /// "#rrggbb".
  [[nodiscard]] std::string colour(double distance) const;
  /// Whether white can be read on that colour.
  [[nodiscard]] bool is_dark(double distance) const;
};

/// A scale whose full colour is at the widest tolerance, or at the largest distance where that is less.
[[nodiscard]] ColourScale colour_scale_of(const Result& result);

/// The smallest of 1, 2, 2.5, 5, 10 times a power of ten that is not below `value`; `value` > 0.
[[nodiscard]] double round_step_above(double value);

}  // namespace bladefit
