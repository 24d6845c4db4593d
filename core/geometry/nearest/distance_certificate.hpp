#pragma once
#include "core/geometry/nearest/minimum_proof.hpp"
#include "core/geometry/surface/bezier.hpp"
#include "core/geometry/surface/foot.hpp"

namespace bladefit {

/// Distances [mm] between which the whole piece lies, from a plane across the direction from r to its middle and from
/// the farthest control point. Cost: two four-vector products a control point.
struct DistanceRange {
  double least = 0, middle = 0, most = 0;  ///< middle: of the mean of the four corners
};
[[nodiscard]] DistanceRange distance_range(const BezierNet& net, const Vec3& r);

/// g(u, v) = |A - w r|^2 - (bound w)^2 = w^2 (distance^2 - bound^2) of a piece of surface, a polynomial of twice the
/// degree in Bernstein form.
/// Where g is convex, a point at distance `bound` that satisfies the first-order conditions is the nearest of the
/// piece. With weights that are not all equal, a local minimum of the distance at D is a stationary point of the g with
/// bound D: its coefficients are linear in D^2, so the hull of its ranges at two bounds
/// holds at all between them.
class DistanceForm {
 public:
  /// Cost: (order_u order_v)^2 / 2 four-vector products, about 140 for a bicubic net.
  DistanceForm(const BezierNet& net, const Vec3& r, double bound);

  /// No point of the piece is nearer than the bound: no coefficient is below -tolerance [mm^2].
  [[nodiscard]] bool farther(double tolerance) const;

  /// Ranges of its derivatives, from the differences of the coefficients. Cost: about 10 operations a coefficient.
  [[nodiscard]] DerivativeRanges ranges() const;

 private:
  static constexpr std::size_t kMaxProductOrder = 2 * kMaxDegree + 1;
  [[nodiscard]] double at(std::uint32_t k, std::uint32_t l) const { return c_[k * (n_ + 1) + l]; }
  template <std::uint32_t DegreeU, std::uint32_t DegreeV>
  void square(const BezierNet& net, const Vec3& r, double bound);

  std::uint32_t m_ = 0, n_ = 0;  ///< degrees of g
  double least_weight_ = 0;
  double size_ = 0;  ///< of the terms that the coefficients are differences of [mm^2]
  std::array<double, kMaxProductOrder * kMaxProductOrder> c_;
};

/// The ranges of the form alone, whose coefficients leave the stack with the call.
[[nodiscard]] DerivativeRanges distance_ranges(const BezierNet& net, const Vec3& r, double bound);

}  // namespace bladefit
