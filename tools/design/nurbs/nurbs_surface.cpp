#include "tools/design/nurbs/nurbs_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// Knots nearer than this part of the range are one knot: CAD systems write 0.30000000000000004 beside 0.3.
constexpr double kSameKnot = 1e-12;
/// A parameter range may stand out of the knots by this part of the range, since some systems print it in few digits.
constexpr double kRangeOvershoot = 1e-6;
/// No blade is larger than this [mm], and beyond it squares of squares leave the range of numbers.
constexpr double kLargestCoordinate = 1e9;

/// What is being checked, for messages, and where repairs are listed.
struct Context {
  std::string file, surface;
  char direction = 'u';
  int highest_degree = 0;
  std::vector<std::string>* notes = nullptr;

  [[noreturn]] void fail(const std::string& what) const {
    throw ToolError(fmt::format("{}: {}: {}", file, surface, what));
  }
  void note(const std::string& what) const { notes->push_back(fmt::format("{}: {}", surface, what)); }
};

void check_counts(const SurfaceDirection& direction, const Context& context) {
  if (direction.degree < 1 || direction.degree > context.highest_degree) {
    context.fail(fmt::format("degree {} in {} is outside 1..{}; export the surface with a degree up to {}",
                             direction.degree, context.direction, context.highest_degree, context.highest_degree));
  }
  if (direction.control_points <= direction.degree) {
    context.fail(fmt::format("{} control points in {} are too few for degree {}; at least {} are needed",
                             direction.control_points, context.direction, direction.degree, direction.degree + 1));
  }
  const auto needed = static_cast<std::size_t>(direction.control_points + direction.degree + 1);
  if (direction.knots.size() != needed) {
    context.fail(fmt::format("{} knots in {}, but {} control points of degree {} need {}; export the surface again",
                             direction.knots.size(), context.direction, direction.control_points, direction.degree,
                             needed));
  }
}

void check_knot_order(const SurfaceDirection& direction, const Context& context) {
  for (std::size_t k = 0; k < direction.knots.size(); ++k) {
    if (!std::isfinite(direction.knots[k])) {
      context.fail(
          fmt::format("knot {} in {} is not a finite number; export the surface again", k + 1, context.direction));
    }
    if (k > 0 && direction.knots[k] < direction.knots[k - 1]) {
      context.fail(fmt::format("decreasing knots in {}: knot {} is {} after {}; export the surface again",
                               context.direction, k + 1, direction.knots[k], direction.knots[k - 1]));
    }
  }
}

/// Moves the ends of the parameter range onto the knots that they mean, or refuses the range.
void check_range(SurfaceDirection& direction, const Context& context) {
  const double first = direction.knots[static_cast<std::size_t>(direction.degree)];
  const double last = direction.knots[static_cast<std::size_t>(direction.control_points)];
  if (!(first < last)) {
    context.fail(fmt::format("the knots in {} leave no parameter range: {} to {}; export the surface again",
                             context.direction, first, last));
  }
  const double margin = kRangeOvershoot * (last - first);
  const bool usable = direction.start < direction.end && direction.start >= first - margin &&
                      direction.end <= last + margin && (direction.end - direction.start) > margin;
  if (!usable) {
    context.fail(
        fmt::format("parameter range {} to {} in {} is degenerate or outside the knots' {} to {}; correct the "
                    "range or export the surface again",
                    direction.start, direction.end, context.direction, first, last));
  }
  if (direction.start < first - kSameKnot * (last - first) || direction.end > last + kSameKnot * (last - first)) {
    context.note(fmt::format("parameter range {} to {} in {} cut to that of the knots, {} to {}", direction.start,
                             direction.end, context.direction, first, last));
  }
  direction.start = std::max(direction.start, first);
  direction.end = std::min(direction.end, last);
}

/// Makes nearly equal knots, and range ends next to knots, equal.
void merge_knots(SurfaceDirection& direction, const Context& context) {
  const double tolerance = kSameKnot * (direction.end - direction.start);
  int moved = 0;
  const auto snap = [&](double& value, double to) {
    if (value != to && std::abs(value - to) <= tolerance) {
      value = to;
      ++moved;
    }
  };
  double group = direction.knots.front();
  for (double& knot : direction.knots) {
    snap(knot, group);
    snap(knot, direction.start);
    snap(knot, direction.end);
    group = knot;
  }
  if (moved > 0) {
    context.note(fmt::format("{} knots in {} within {:.1g} of another one made equal to it", moved, context.direction,
                             tolerance));
  }
}

void check_multiplicity(const SurfaceDirection& direction, const Context& context) {
  for (std::size_t k = 0; k < direction.knots.size();) {
    const double knot = direction.knots[k];
    int multiplicity = 0;
    for (; k < direction.knots.size() && direction.knots[k] == knot; ++k) ++multiplicity;
    if (multiplicity > direction.degree + 1) {
      context.fail(fmt::format("knot {} in {} has multiplicity {}, more than degree + 1 = {}; export the surface again",
                               knot, context.direction, multiplicity, direction.degree + 1));
    }
    if (multiplicity > direction.degree && knot > direction.start && knot < direction.end) {
      context.fail(
          fmt::format("the surface is torn at {} = {}: the knot has multiplicity {} for degree {}; split it "
                      "there into two surfaces",
                      context.direction, knot, multiplicity, direction.degree));
    }
  }
}

void check_direction(SurfaceDirection& direction, const Context& context) {
  check_counts(direction, context);
  check_knot_order(direction, context);
  check_range(direction, context);
  merge_knots(direction, context);
  check_multiplicity(direction, context);
}

/// Weights of which one outweighs all others leave of a surface little but one point.
void check_weights(const NurbsSurface& surface, const Context& context) {
  const auto [least, most] = std::ranges::minmax_element(surface.weights);
  if (surface.weights.empty() || *most <= kLargestWeightRatio * *least) return;
  context.fail(fmt::format("the weights differ beyond reason, from {} to {}; export the surface again", *least, *most));
}

void check_net(const NurbsSurface& surface, const Context& context) {
  const auto count =
      static_cast<std::size_t>(surface.u.control_points) * static_cast<std::size_t>(surface.v.control_points);
  if (surface.control_points.size() != count || surface.weights.size() != count) {
    context.fail(fmt::format("{} control points and {} weights where {} x {} are needed; export the surface again",
                             surface.control_points.size(), surface.weights.size(), surface.u.control_points,
                             surface.v.control_points));
  }
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = k / static_cast<std::size_t>(surface.v.control_points);
    const std::size_t j = k % static_cast<std::size_t>(surface.v.control_points);
    if (!surface.control_points[k].allFinite()) {
      context.fail(fmt::format("control point ({}, {}) is not a finite number; export the surface again", i, j));
    }
    if (surface.control_points[k].cwiseAbs().maxCoeff() > kLargestCoordinate) {
      context.fail(fmt::format("control point ({}, {}) is over {} mm away; correct the file or its unit", i, j,
                               kLargestCoordinate));
    }
    if (!std::isfinite(surface.weights[k]) || surface.weights[k] <= 0) {
      context.fail(fmt::format("weight ({}, {}) is {}, but weights must be above 0; export the surface again", i, j,
                               surface.weights[k]));
    }
  }
  check_weights(surface, context);
}

}  // namespace

std::vector<std::string> check_surface(NurbsSurface& surface, const std::string& file, int highest_degree) {
  std::vector<std::string> notes;
  Context context{file, surface.name, 'u', highest_degree, &notes};
  check_direction(surface.u, context);
  context.direction = 'v';
  check_direction(surface.v, context);
  check_net(surface, context);
  return notes;
}

}  // namespace bladefit
