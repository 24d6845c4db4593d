#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/geometry/surface/surface.hpp"

namespace bladefit::testing {

/// What random balls that touch a design and are no greater than its reach have met.
struct TouchingBalls {
  std::size_t tried = 0, tested = 0;  ///< of those tried some stand where nothing is known, or beyond a trim loop
  std::size_t held = 0;               ///< hold a point of the design: by a grid over it, or by a search
  std::size_t rivals = 0;             ///< have another local minimum at their centre that the reach rules out
  std::string first;                  ///< of these

  [[nodiscard]] double tested_share() const { return static_cast<double>(tested) / static_cast<double>(tried); }
};

/// Half of the balls are as large as the reach, half of them smaller. Cost: some ten microseconds a ball.
[[nodiscard]] TouchingBalls touching_balls(const Surface& surface, std::size_t count, std::uint64_t seed);

/// Balls a design: `usual`, or what the environment asks for by BLADEFIT_BALLS.
[[nodiscard]] std::size_t balls_asked(std::size_t usual);

}  // namespace bladefit::testing
