#pragma once
#include "tools/search/candidate_fit.hpp"
#include "tools/search/design_samples.hpp"

namespace bladefit {

/// Length against which the distances of a fit are weighed [mm]: half the extent of the points, at most the half
/// diagonal of the design. Real blades are within some thousandths of it.
[[nodiscard]] double scale_of(const DesignSamples& samples, double extent_mm);
[[nodiscard]] double scale_of(double half_diagonal_mm, double extent_mm);

/// Whether points that lie like this may belong to the design: three quarters of them within a hundredth of the scale.
[[nodiscard]] bool is_credible(const PoseFit& fit, double scale_mm);

/// The same of a finished fit for which no better pose was found: the blade may be a rough casting, three quarters of
/// the points within three hundredths.
[[nodiscard]] bool is_plausible(const PoseFit& fit, double scale_mm);

/// The same where the frame of the points is known, so that they cannot have slid beside the design: those beyond its
/// edges were probed where it has no surface, and say nothing against the others, at least half of all.
[[nodiscard]] bool is_plausible_in_frame(const PoseFit& fit, double scale_mm);

/// Whether it is worth looking for a better pose: three quarters of them are not within some thousandths.
[[nodiscard]] bool is_suspect(const PoseFit& fit, double scale_mm);

}  // namespace bladefit
