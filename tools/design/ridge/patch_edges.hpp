#pragma once
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <vector>

#include "core/geometry/surface/surface.hpp"

namespace bladefit {

/// A place on one of the four edges of a patch; edges are numbered as the sides of spans: kLowU, kHighU, kLowV, kHighV.
struct EdgePlace {
  std::uint32_t patch = 0;
  std::size_t edge = kLowU;
  double t = 0;  ///< the parameter along the edge
};

/// The edges of all patches, and which of them lie side by side.
class PatchEdges {
 public:
  /// `surface` must outlive it. Cost: 260 evaluations a patch.
  explicit PatchEdges(const Surface& surface);

  [[nodiscard]] const Surface& surface() const { return surface_; }

  /// The place on another edge, or on another one of the same patch, where the surface goes on beyond `place`; nothing
  /// at an outer edge. Both edges must run in about the same direction there, not farther apart than the gap of a
  /// joint. Cost: some microseconds an edge whose box is near.
  [[nodiscard]] std::optional<EdgePlace> beyond(const EdgePlace& place) const;

 private:
  static constexpr std::size_t kSamples = 64;  ///< steps along an edge
  struct Edge {
    std::array<Vec3, kSamples + 1> points;
    Eigen::AlignedBox3d box;
  };

  [[nodiscard]] Vec3 point_on(const EdgePlace& place) const;
  [[nodiscard]] Vec3 direction_of(const EdgePlace& place) const;
  /// The nearest place of one edge, and how far it is.
  [[nodiscard]] std::pair<EdgePlace, double> nearest_on(std::uint32_t patch, std::size_t edge, const Vec3& point) const;

  const Surface& surface_;
  double gap_;
  std::vector<std::array<Edge, 4>> edges_;  ///< one a patch
};

}  // namespace bladefit
