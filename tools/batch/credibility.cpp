#include "tools/batch/credibility.hpp"

#include <algorithm>

namespace bladefit {
namespace {

/// [scale] The largest typical distance of points of this design, and that above which a wrong pose is as likely.
constexpr double kCredible = 0.01, kSuspect = 0.008;
/// [scale] The largest typical distance of a rough casting of this design.
constexpr double kPlausible = 0.03;
constexpr std::uint32_t kLeastPoints = 6;

}  // namespace

double scale_of(double half_diagonal_mm, double extent_mm) { return std::min(half_diagonal_mm, 0.5 * extent_mm); }

double scale_of(const DesignSamples& samples, double extent_mm) {
  return scale_of(samples.half_diagonal_mm, extent_mm);
}

bool is_credible(const PoseFit& fit, double scale_mm) {
  return fit.counted >= std::min(kLeastPoints, fit.points) && fit.typical_mm <= kCredible * scale_mm;
}

bool is_plausible(const PoseFit& fit, double scale_mm) {
  return fit.counted >= std::min(kLeastPoints, fit.points) && fit.typical_mm <= kPlausible * scale_mm;
}

bool is_plausible_in_frame(const PoseFit& fit, double scale_mm) {
  return fit.counted >= std::min(kLeastPoints, fit.points) && 2 * fit.counted >= fit.points &&
         fit.rms_mm <= kPlausible * scale_mm;
}

bool is_suspect(const PoseFit& fit, double scale_mm) {
  return fit.counted < std::min(kLeastPoints, fit.points) || fit.typical_mm > kSuspect * scale_mm;
}

}  // namespace bladefit
