#pragma once
#include <optional>
#include <vector>

#include "tools/design/ridge/section_ridges.hpp"

namespace bladefit {

/// A section of a blade with the places where the blade's ridges cross it.
struct RidgedSection {
  double constant = 0;  ///< the parameter of the patch that the section begins on
  SectionLine line;
  std::optional<SectionRidge> ridges[2];
};

/// A blade, or a part of one whose sections are isoparameter lines of the same patches.
struct RidgedBlade {
  IsoLine start;                        ///< of the sections; its constant is that of none in particular
  std::vector<RidgedSection> sections;  ///< from 0 to 1 of the constant parameter, evenly spaced
  std::size_t count = 0;                ///< ridges, 1 or 2

  /// Length of a ridge [mm].
  [[nodiscard]] double length_of(std::size_t ridge) const;
  /// The place of a ridge in the section nearest to the middle of the blade that has it.
  [[nodiscard]] const SectionRidge& middle_of(std::size_t ridge) const;
  /// How far a place is from a ridge [mm].
  [[nodiscard]] double distance_of(std::size_t ridge, const Vec3& place) const;
};

/// The blades with ridges in a design, `sections` sections each: of every patch those isoparameter lines around it are
/// taken that cross the longer ridges, and a patch that is crossed by the sections of another one is not looked at
/// again. Empty where nothing bends enough. Cost: some milliseconds a section.
[[nodiscard]] std::vector<RidgedBlade> find_ridges(const Surface& surface, std::size_t sections);

}  // namespace bladefit
