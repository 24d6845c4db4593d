#include "tools/design/loft/foil.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tools/design/loft/not_a_knot.hpp"

namespace bladefit {
namespace {

constexpr double kNose66 = 0.448;  ///< Brockett
/// Thickness of NACA 66 (mod) at shares of the chord (Brockett).
constexpr std::array<double, 18> kPlaces66 = {0,   0.0125, 0.025, 0.05, 0.075, 0.1, 0.15, 0.2,  0.3,
                                              0.4, 0.45,   0.5,   0.6,  0.7,   0.8, 0.9,  0.95, 1};
constexpr std::array<double, 18> kThickness66 = {0,      0.2088, 0.2932, 0.4132, 0.5050, 0.5814,
                                                 0.7042, 0.8,    0.9274, 0.9904, 1,      0.9924,
                                                 0.9306, 0.8070, 0.6220, 0.3754, 0.2286, 0.0666};

/// y / sqrt(x) over sqrt(x): it has no infinite slope, and its beginning is the radius of the nose.
NotAKnotSpline nose_spline() {
  std::vector<double> roots, values;
  for (std::size_t k = 0; k < kPlaces66.size(); ++k) {
    const double root = std::sqrt(kPlaces66.at(k));
    roots.push_back(root);
    values.push_back(k == 0 ? std::sqrt(2 * kNose66) : 0.5 * kThickness66.at(k) / root);
  }
  return {roots, values};
}

double half_thickness_16(double x) {
  if (x < 0.5) return 0.989665 * std::sqrt(x) - 0.23925 * x - 0.041 * x * x - 0.5594 * x * x * x;
  const double rest = 1 - x;
  return 0.01 + 2.325 * rest - 3.42 * rest * rest + 1.46 * rest * rest * rest;
}

/// x^2 log x, 0 at 0.
double square_log(double x) { return x > 0 ? x * x * std::log(x) : 0.0; }

/// The mean line of a = 0.8 for a lift coefficient of 2 pi (a + 1).
double line_08(double x) {
  constexpr double a = 0.8;
  const double g = -(a * a * (0.5 * std::log(a) - 0.25) + 0.25) / (1 - a);
  const double h = ((1 - a) * (1 - a) * (0.5 * std::log(1 - a) - 0.25)) / (1 - a) + g;
  const double log_x = x > 0 ? x * std::log(x) : 0.0;
  const double distance = std::abs(a - x), rest = 1 - x;
  const double load = 0.5 * square_log(distance) - 0.5 * square_log(rest) + 0.25 * (rest * rest - distance * distance);
  return load / (1 - a) - log_x + g - h * x;
}

/// The mean line of a = 1.
double line_10(double x) {
  const auto part = [](double t) { return t > 0 ? -t * std::log(t) : 0.0; };
  return part(x) + part(1 - x);
}

}  // namespace

double half_thickness(Foil foil, double x) {
  if (foil == Foil::naca16) return half_thickness_16(x);
  static const NotAKnotSpline kSpline = nose_spline();
  const double root = std::sqrt(x);
  return root * kSpline.at(root);
}

double nose_radius(Foil foil) { return foil == Foil::naca66 ? kNose66 : 0.5 * 0.989665 * 0.989665; }

double mean_line(Foil foil, double x) {
  static const double kMost08 = line_08(0.5), kMost10 = std::numbers::ln2;
  return foil == Foil::naca66 ? line_08(x) / kMost08 : line_10(x) / kMost10;
}

}  // namespace bladefit
