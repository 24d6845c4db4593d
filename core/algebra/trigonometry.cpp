#include "core/algebra/trigonometry.hpp"

#include <cmath>
#include <numbers>

namespace bladefit {
namespace {

constexpr double kPi = std::numbers::pi;
/// pi less its double.
constexpr double kPiRest = 1.2246467991473532e-16;
/// pi/2 in parts: the first two have 33 bits, so that their products with a number of quarter turns are exact.
constexpr double kQuarter1 = 0x1.921fb544p+0, kQuarter2 = 0x1.0b4611a6p-34, kQuarter3 = 0x1.3198a2e037073p-69;

/// Terms of the series from the last to the first: their rests are below 1e-19 for |r| <= pi/4.
constexpr int kTerms = 9;
/// The same of the arc tangent, for |t| <= tan(pi/16).
constexpr int kArcTerms = 12;

/// sin(r) / r - 1 from r^2, |r| <= pi/4.
double sine_rest(double r2) {
  double sum = 0.0;
  for (int k = kTerms; k > 0; --k) sum = -r2 / (2.0 * k * (2.0 * k + 1.0)) * (1.0 + sum);
  return sum;
}

/// cos(r) - 1 from r^2, |r| <= pi/4.
double cosine_rest(double r2) {
  double sum = 0.0;
  for (int k = kTerms; k > 0; --k) sum = -r2 / (2.0 * k * (2.0 * k - 1.0)) * (1.0 + sum);
  return sum;
}

/// sin(x + quarters * pi/2).
double turned_sine(double x, int quarters) {
  const double turns = std::floor(x / (0.5 * kPi) + 0.5);
  const double first = x - turns * kQuarter1, second = turns * kQuarter2;
  const double high = first - second, low = ((first - high) - second) - turns * kQuarter3;
  const double r = high + low, rest = (high - r) + low;
  const double quarter = turns + quarters - 4.0 * std::floor(0.25 * (turns + quarters));  // 0, 1, 2 or 3
  const bool odd = quarter == 1.0 || quarter == 3.0;
  const double value = odd ? 1.0 + (cosine_rest(r * r) - r * rest) : r + (r * sine_rest(r * r) + rest);
  return quarter < 2.0 ? value : -value;
}

/// atan(t), 0 <= t <= 1.
double arc_tangent(double t) {
  // From pi/8 on the angle is measured from pi/4; half of what remains is within the series' range.
  const bool upper = t > std::numbers::sqrt2 - 1.0;
  const double s = upper ? (t - 1.0) / (t + 1.0) : t;
  const double half = s / (1.0 + std::sqrt(1.0 + s * s)), h2 = half * half;
  double sum = 0.0;
  for (int k = kArcTerms; k > 0; --k) sum = h2 * ((k % 2 == 0 ? 1.0 : -1.0) / (2.0 * k + 1.0) + sum);
  const double angle = 2.0 * half + 2.0 * half * sum;
  return upper ? 0.25 * kPi + (angle + 0.25 * kPiRest) : angle;
}

}  // namespace

double sine(double x) { return turned_sine(x, 0); }

double cosine(double x) { return turned_sine(x, 1); }

double angle_of(double y, double x) {
  const double width = std::abs(x), height = std::abs(y);
  if (width == 0.0 && height == 0.0) return 0.0;
  double angle =
      height <= width ? arc_tangent(height / width) : 0.5 * kPi - (arc_tangent(width / height) - 0.5 * kPiRest);
  if (x < 0.0) angle = kPi - (angle - kPiRest);
  return y < 0.0 ? -angle : angle;
}

}  // namespace bladefit
