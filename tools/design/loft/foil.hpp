#pragma once
#include <array>
#include <string_view>

namespace bladefit {

/// Families of blade sections.
enum class Foil {
  naca66,  ///< NACA 66 with the nose and tail that the David Taylor Model Basin gave it, mean line a = 0.8
  naca16,  ///< NACA 16, mean line a = 1
};
inline constexpr std::array<std::string_view, 2> kFoilWords = {"naca66", "naca16"};

/// Half of the thickness at x, as a share of the greatest thickness; x is the share of the chord from the leading edge,
/// 0..1. At the leading edge it goes as sqrt(2 rho x), rho = nose_radius(): the radius of the nose is kept.
/// NACA 66 (mod): ordinates and radius of T. Brockett, Minimum Pressure Envelopes for Modified NACA-66 Sections with
/// NACA a = 0.8 Camber and Buships Type I and Type II Sections, DTMB Report 1780, 1966; between them a spline of
/// y / sqrt(x) over sqrt(x). NACA 16: W. F. Lindsey, D. B. Stevenson, B. N. Daley, Aerodynamic Characteristics of 24
/// NACA 16-Series Airfoils, NACA TN 1546, 1948.
[[nodiscard]] double half_thickness(Foil foil, double x);

/// Radius of the leading edge: that much times (thickness / chord)^2 of the chord.
[[nodiscard]] double nose_radius(Foil foil);

/// The mean line at x, as a share of the camber, which is taken at half chord as Brockett does (for a = 0.8 the line
/// rises by 0.07 % more a little behind it): I. H. Abbott, A. E. von Doenhoff, Theory of Wing Sections, 1959, eq. 4.26
/// and 4.27, for a = 0.8 and a = 1, without the turn by the ideal angle.
[[nodiscard]] double mean_line(Foil foil, double x);

}  // namespace bladefit
