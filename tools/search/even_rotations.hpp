#pragma once
#include <vector>

#include "core/algebra/matrix.hpp"

namespace bladefit {

/// Rotations spread evenly over all there are, always the same ones: super-Fibonacci spirals (Alexa 2022). 600 of them
/// leave none farther than some 25 degrees.
[[nodiscard]] std::vector<Mat3> even_rotations(std::size_t count);

}  // namespace bladefit
