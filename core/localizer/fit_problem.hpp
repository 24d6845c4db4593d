#pragma once
#include "core/fit/motion_frame.hpp"
#include "core/geometry/surface/surface.hpp"
#include "core/localizer.hpp"

namespace bladefit {

/// What is fitted to what: constant from create() on. Lengths in mm; [L] are half diagonals of the design.
struct FitProblem {
  /// The memory under `design` must outlive it.
  FitProblem(const DesignImage& design, const LocalizerConfig& wanted);

  /// Longest step of a pose, and of a program [mm].
  [[nodiscard]] double reach() const;
  /// `pose` moved by x, with the locked degrees of freedom of the start pose.
  [[nodiscard]] Pose moved_and_held(const Pose& pose, const Vec6& x) const;
  /// What a foot belongs to.
  [[nodiscard]] MapPart part_of(const Foot& foot) const {
    return part_at(config.tolerance, foot.patch, foot.u, foot.v, foot.point);
  }
  [[nodiscard]] Region region_of(const Foot& foot) const { return part_of(foot).region; }
  /// Of a foot in `part` [mm], on the side of its distance.
  [[nodiscard]] double tolerance_of(const Foot& foot, MapPart part) const;
  /// On both sides [mm], of a foot in `zone` that has `tolerance` on the side of its distance.
  [[nodiscard]] Limits limits_of(std::uint8_t zone, double tolerance) const {
    return zone == 0 ? Limits::both(tolerance) : config.tolerance.zones[zone - 1].limits();
  }
  /// Whether a point can be taken in: ok, not_finite or out_of_range. Its sequence is only checked for 0.
  [[nodiscard]] Status check(const ProbePoint& point) const;
  [[nodiscard]] bool on_design(const SurfacePlace& place) const;

  Surface surface;
  LocalizerConfig config;  ///< with determined_mm filled in
  MotionFrame frame;
};

[[nodiscard]] inline Vec3 to_vec3(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

}  // namespace bladefit
