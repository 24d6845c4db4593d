#pragma once
#include <cstdint>
#include <random>

#include "core/geometry/surface/surface.hpp"

namespace bladefit::testing {

inline double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Vec3 random_vector(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

inline Vec3 random_direction_in_space(std::mt19937_64& random) { return random_vector(random).normalized(); }

/// A place anywhere on the design, in the interior of a span.
inline SurfacePlace random_place(const Surface& surface, std::mt19937_64& random) {
  const auto spans = static_cast<std::uint32_t>(surface.image().spans().size());
  const std::uint32_t span = std::uniform_int_distribution<std::uint32_t>(0, spans - 1)(random);
  const SpanDomain d = surface.domain(span);
  const double u = uniform(random, d.u_min, d.u_max);
  return {span, u, uniform(random, d.v_min, d.v_max)};
}

}  // namespace bladefit::testing
