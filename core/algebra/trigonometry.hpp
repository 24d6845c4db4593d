#pragma once

namespace bladefit {

/// sin(x), |x| <= 1e5 [rad], and its like below: within 2 units in the last place (beside a zero of x itself: 1e-16),
/// and the same bits by every compiler and C library, which those of <cmath> are not. Source: Taylor's series after
/// reduction to an eighth of a turn, with pi/2 in three parts (Cody and Waite 1980).
[[nodiscard]] double sine(double x);
[[nodiscard]] double cosine(double x);

/// The angle of (x, y) from the x axis, -pi to pi [rad]; 0 for (0, 0). Finite arguments. Within 4 units in the last
/// place, and the same bits as above.
[[nodiscard]] double angle_of(double y, double x);

}  // namespace bladefit
