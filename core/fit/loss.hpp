#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace bladefit {

/// How a distance counts in a least-squares fit.
enum class Loss : std::uint8_t {
  none = 0,   ///< 1/2 d^2
  huber = 1,  ///< |d| beyond 1.345 scales: an outlier pulls no harder than that
  tukey = 2   ///< constant beyond 4.685 scales: an outlier does not pull at all
};

/// The words of the losses on the command line, in files and in results, in the order of their values.
inline constexpr std::array<std::string_view, 3> kLossWords = {"none", "huber", "tukey"};

constexpr std::string_view word_of(Loss loss) { return kLossWords[static_cast<std::size_t>(loss)]; }

/// One distance in the sum, with the derivatives that Newton's method needs.
struct LossTerms {
  double value = 0;      ///< rho(d) [mm^2]
  double slope = 0;      ///< psi = d rho / dd [mm]
  double curvature = 1;  ///< d psi / dd
  double weight = 1;     ///< psi / d: of the point in the fit, 0..1
};

/// Terms of the distance `d` with the standard deviation `scale` > 0 of good points [mm]. The constants give 95 % of
/// the efficiency of least squares on normal errors (Huber 1964; Beaton and Tukey 1974).
[[nodiscard]] LossTerms loss_terms(Loss loss, double scale, double d);

}  // namespace bladefit
