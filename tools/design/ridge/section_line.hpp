#pragma once
#include <vector>

#include "tools/design/ridge/patch_edges.hpp"

namespace bladefit {

/// A place on a section.
struct SectionPoint {
  std::uint32_t patch = 0;
  double u = 0, v = 0;
  Vec3 point = Vec3::Zero();   ///< [mm]
  Vec3 normal = Vec3::Zero();  ///< outward unit normal
  double arc = 0;              ///< length along the section from its beginning [mm]
  double turn = 0;             ///< how far the normal has turned up to here, each turn counted as positive [rad]
};

/// The isoparameter line of one patch that a section begins with.
struct IsoLine {
  std::uint32_t patch = 0;
  bool along_u = true;  ///< v is constant; otherwise u is
  double constant = 0.5;
};

/// A line around the blade: an isoparameter line of a patch, followed across the joints of patches.
struct SectionLine {
  std::vector<SectionPoint> points;  ///< so close together that the normal turns little from one to the next
  bool closed = false;               ///< the last point is the first one

  [[nodiscard]] double length() const { return points.back().arc; }
};

/// The section that `start` is part of, from an outer edge to another or around the blade back to its beginning.
/// Cost: some thousand evaluations and a few searches of edges.
[[nodiscard]] SectionLine section_line(const PatchEdges& edges, const IsoLine& start);

/// The place on a section at `arc` [mm] from its beginning, exact to some millionths of a step: between two points the
/// parameter is sought on the surface. `arc` is clamped to the section; a closed one goes on at its beginning.
[[nodiscard]] SectionPoint place_on(const Surface& surface, const SectionLine& section, double arc);

}  // namespace bladefit
