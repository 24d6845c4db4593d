// Sine, cosine and arc tangent against the C library's in long double, and at places that are known.
#include "core/algebra/trigonometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace bladefit {
namespace {

/// Units in the last place between a value and what it should be.
double last_places(double value, long double exact) {
  const double nearest = static_cast<double>(exact);
  const double place = std::nextafter(std::abs(nearest), HUGE_VAL) - std::abs(nearest);
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact) / static_cast<long double>(place));
}

TEST(Trigonometry, SineAndCosineAreThoseOfLongDouble) {
  std::mt19937_64 random(1);
  double worst = 0.0;
  for (const double largest : {1e-6, 0.1, 1.0, 4.0, 100.0, 1e5}) {
    std::uniform_real_distribution<double> angle(-largest, largest);
    for (int k = 0; k < 20000; ++k) {
      const double x = angle(random);
      worst = std::max({worst, last_places(sine(x), std::sin(static_cast<long double>(x))),
                        last_places(cosine(x), std::cos(static_cast<long double>(x)))});
    }
  }
  EXPECT_LT(worst, 2.0);
}

TEST(Trigonometry, AnglesAreThoseOfLongDouble) {
  std::mt19937_64 random(2);
  double worst = 0.0;
  std::uniform_real_distribution<double> digits(-1.0, 1.0), size(-12.0, 12.0);
  for (int k = 0; k < 100000; ++k) {
    const double y = digits(random) * std::pow(10.0, size(random)), x = digits(random);
    worst = std::max(worst,
                     last_places(angle_of(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
  }
  EXPECT_LT(worst, 4.0);
}

TEST(Trigonometry, KnownPlacesAreExact) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_EQ(sine(0.0), 0.0);
  EXPECT_EQ(cosine(0.0), 1.0);
  EXPECT_EQ(sine(0.5 * kPi), 1.0);
  EXPECT_EQ(cosine(kPi), -1.0);
  EXPECT_EQ(angle_of(0.0, 0.0), 0.0);
  EXPECT_EQ(angle_of(0.0, 1.0), 0.0);
  EXPECT_EQ(angle_of(0.0, -1.0), kPi);
  EXPECT_EQ(angle_of(1.0, 0.0), 0.5 * kPi);
  EXPECT_EQ(angle_of(-1.0, 0.0), -0.5 * kPi);
  EXPECT_EQ(angle_of(1.0, 1.0), 0.25 * kPi);
  EXPECT_EQ(angle_of(-1.0, -1.0), -0.75 * kPi);
}

}  // namespace
}  // namespace bladefit
