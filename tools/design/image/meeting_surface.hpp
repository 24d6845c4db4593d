#pragma once
#include <optional>

#include "core/geometry/nearest/local_projection.hpp"
#include "core/geometry/surface/surface.hpp"

namespace bladefit {

/// Where another surface comes near to an edge.
struct MeetingPlace {
  double distance = 0;
  Vec3 normal = Vec3::Zero();  ///< outward, of the other surface
  std::optional<Vec3> inward;  ///< unit vector into the other surface; nothing where the edge meets it in its middle
  double rank = 0;             ///< of several the one of the least counts [mm]
};

/// The nearest place of a piece of a trim loop.
struct TrimPlace {
  SurfacePlace place;
  SurfacePoint at;
  Vec3 offset;  ///< from it to the point [mm]
  Vec3 inward;  ///< unit vector into the face
};

/// Finds where a design meets itself.
class MeetingSurface {
 public:
  explicit MeetingSurface(const Surface& surface);

  /// The nearest place within joint_gap() of the point at `own`, on another patch, or on the same one where what lies
  /// between the two is not near. Cost: some microseconds.
  [[nodiscard]] std::optional<MeetingPlace> find(const SurfacePlace& own, const Vec3& point) const;

  /// From a place of an outer edge to the nearest one of another that faces it: across the material, where that surface
  /// ends too, within a few hundredths of the half diagonal. `onward`: unit vector out of the surface at the place, in
  /// it. Cost: some microseconds.
  [[nodiscard]] std::optional<Vec3> facing_edge(const SurfacePlace& own, const Vec3& point, const Vec3& normal,
                                                const Vec3& onward) const;

  /// There is surface some gaps away from the point in this direction, and it does not end there.
  [[nodiscard]] bool reaches(const Vec3& point, const Vec3& direction) const;

 private:
  /// Calls `use_leaf` or `use_run` with the index of every leaf and every run of trims whose box is nearer to the point
  /// than `reach`.
  template <class UseLeaf, class UseRun>
  void each_near(const Vec3& point, double reach, UseLeaf use_leaf, UseRun use_run) const;
  void look_in(std::uint32_t leaf, const SurfacePlace& own, const Vec3& point, std::optional<MeetingPlace>& best) const;
  void look_in_part(std::uint32_t span, const ParameterLimits& limits, const SurfacePlace& own, const Vec3& point,
                    std::optional<MeetingPlace>& best) const;
  void look_at(const TrimPlace& found, const SurfacePlace& own, const Vec3& point,
               std::optional<MeetingPlace>& best) const;
  [[nodiscard]] bool connected(const SurfacePlace& a, const SurfacePlace& b, const Vec3& point) const;

  const Surface& surface_;
  double gap_;
};

}  // namespace bladefit
