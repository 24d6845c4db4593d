#pragma once
#include <limits>

#include "core/geometry/nearest/global_projection.hpp"

namespace bladefit {

/// The nearest of the local minima a global search has met, its runner-up and the distance of the next.
class NearestSoFar {
 public:
  NearestSoFar(const Surface& surface, const ProjectionQuery& query);

  /// Takes a local minimum into account. One that does not face the probe is no foot, nor is one outside of the trim
  /// loops, nor a place where Newton's method found no proper minimum: that is kept as a last resort.
  void consider(const Projection& candidate);

  /// Takes into account that there may be a local minimum about `place`, no nearer than `least` [mm], which cannot be
  /// told from its neighbours.
  void consider_possible(const Projection& place, double least);

  [[nodiscard]] bool found() const { return found_; }
  /// Nothing is found yet, and a descent from the next leaf may find something. A few may: where many have not, it may
  /// be that no local minimum faces the probe, which only the bounds of all leaves can tell.
  [[nodiscard]] bool takes_start() { return !found_ && starts_++ < kMostStarts; }
  [[nodiscard]] const Projection& nearest() const { return nearest_; }
  [[nodiscard]] double distance() const { return distance_; }
  /// What is not nearer than this does not matter [mm].
  [[nodiscard]] double limit() const { return found_ ? distance_ + margin_ - slack_ : kNowhere; }
  [[nodiscard]] double slack() const { return slack_; }
  [[nodiscard]] bool directed() const { return directed_; }

  /// What is not nearer than this is not nearer than the nearest [mm].
  [[nodiscard]] double least_that_matters() const { return found_ ? distance_ - slack_ : kNowhere; }
  /// The outcome of a search that met everything nearer than limit().
  [[nodiscard]] GlobalProjection result(bool exhausted, std::uint32_t pieces) const;

 private:
  void note_runner_up(const Projection& candidate, double distance);
  [[nodiscard]] bool same(const Vec3& a, const Vec3& b) const;
  static constexpr double kNowhere = std::numeric_limits<double>::infinity();
  static constexpr std::uint32_t kMostStarts = 16;
  const Surface& surface_;
  const Vec3& approach_;
  double margin_, slack_;
  bool directed_, found_ = false, has_resort_ = false;
  std::uint32_t starts_ = 0;
  double distance_ = 0.0, runner_up_distance_ = kNowhere, third_distance_ = kNowhere;
  Projection nearest_;
  Vec3 runner_up_ = Vec3::Zero();  ///< on the surface
  SurfacePlace runner_up_place_;
  Projection resort_;  ///< the nearest place that is not a proper minimum
};

/// Local minima this near to each other are one [half diagonals].
inline constexpr double kSameFoot = 1e-7;

/// A local minimum whose normal is this near to facing the probe [rad] may come to face it while the point is tracked.
inline constexpr double kAlmostFacing = 0.05;

}  // namespace bladefit
