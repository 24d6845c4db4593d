#pragma once
#include <optional>
#include <vector>

#include "tools/design/ridge/section_line.hpp"

namespace bladefit {

/// A place on a section about which it bends most: a leading or a trailing edge.
struct SectionRidge {
  SectionPoint place;
  double radius_mm = 0;  ///< about which it bends there; 0 at a crease
};

/// The ridges of a section, at most two, the sharpest first. A ridge is the middle of the shortest part over which the
/// normal turns by 45 degrees, where it turns by `least_degrees` or more within a tenth of the section. So it is where
/// the curvature is greatest, without the waves that a fitted spline has within its rounding; at a crease it is the
/// crease. The two are a sixth of the section apart, or more. Cost: linear in the points.
[[nodiscard]] std::vector<SectionRidge> section_ridges(const Surface& surface, const SectionLine& section,
                                                       double least_degrees);

/// The ridge of a section that goes on from one of a neighbouring section, whose arc was the share `share` of its
/// length: the same, sought no farther from there than `reach` of the length. Nothing where it turns by less there.
[[nodiscard]] std::optional<SectionRidge> ridge_going_on(const Surface& surface, const SectionLine& section,
                                                         double share, double reach, double least_degrees);

/// Length from one ridge to the other, or to the end of the section, on the side to which the arc rises and on the
/// other [mm]: as far as a zone about the ridge may reach.
struct SectionSides {
  double after = 0, before = 0;
};
[[nodiscard]] SectionSides sides_of(const SectionLine& section, const SectionRidge& ridge, const SectionRidge* other);

/// From the ridge in a straight line to the other ridge or, where there is none, to the farthest point of the section
/// [mm].
[[nodiscard]] double chord_of(const SectionLine& section, const SectionRidge& ridge, const SectionRidge* other);

}  // namespace bladefit
