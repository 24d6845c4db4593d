#pragma once
#include <cstddef>

#include "core/geometry/nearest/local_projection.hpp"
#include "core/geometry/surface/bezier.hpp"

namespace bladefit {

/// A side of a patch that is one point, a pole, as at the tip of a blade: the parameter along it tells nothing there,
/// and the surface leaves it in as many directions as that parameter has values. A point has its foot at the pole where
/// the distance falls along none of them.

inline constexpr std::size_t kNoSide = 4;
[[nodiscard]] constexpr bool is_along_v(std::size_t side) { return side == kLowU || side == kHighU; }
[[nodiscard]] constexpr bool is_high(std::size_t side) { return side == kHighU || side == kHighV; }

/// The side of its patch that `place` is on, where that side is within `size` [mm] one point; else kNoSide. `at`: the
/// surface there. Cost: some comparisons; one subtraction a control point of the side where the tangent along it is
/// that short.
[[nodiscard]] std::size_t pole_side(const Surface& surface, const SurfacePlace& place, const SurfacePoint& at,
                                    double size);

/// Where a span has a pole in each of its parameters.
enum class PoleEnd : std::uint8_t { none, low, high };
struct SpanPoles {
  PoleEnd u = PoleEnd::none, v = PoleEnd::none;
  [[nodiscard]] bool any() const { return u != PoleEnd::none || v != PoleEnd::none; }
};

/// The sides of its patch that the span has which are within `size` [mm] one point. Cost: a row of
/// the span's net for each of these.
[[nodiscard]] SpanPoles poles_of(const Surface& surface, std::uint32_t span, double size);

/// Where a piece of a surface is cut that is from `low` to `high` [spans] away from a pole: a piece at the pole at
/// `share` of it; else in the geometric mean, since about a pole things repeat on every scale.
[[nodiscard]] double pole_cut(double low, double high, double share);

/// No two places of the piece are farther apart than this [mm]. Cost: one subtraction a control point.
[[nodiscard]] double extent_of(const BezierNet& net);

/// How the distance from a point changes on the ways from a pole into the surface.
struct PoleWay {
  SurfacePlace place;  ///< the pole, with the parameter along its side of the way on which the distance falls most
  double slope = 0;    ///< of half the squared distance along it [mm]: below 0 it falls
  bool falls = false;  ///< by more than rounding, or as from a greatest value
};

/// The way on which the distance falls most, or rises least, of those that were tried between the limits. `offset`:
/// r - pole [mm]; a slope within `level` [mm] of 0 is rounding. Of spans whose control points next to the side tell
/// that it falls on no way none is tried, of others two a degree.
[[nodiscard]] PoleWay steepest_from_pole(const Surface& surface, const SurfacePlace& pole, std::size_t side,
                                         const Vec3& offset, const ParameterLimits& limits, double level);

}  // namespace bladefit
