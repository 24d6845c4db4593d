#include "tools/design/nurbs/surface_samples.hpp"

#include <cmath>
#include <numbers>

#include "core/geometry/surface/surface.hpp"
#include "core/geometry/surface/trim.hpp"
#include "tools/files/random_numbers.hpp"

namespace bladefit {
namespace {

/// Standard normal numbers (Box and Muller, 1958).
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : uniform_(seed) {}

  double next() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform_.next_fraction()));
    return radius * std::cos(2 * std::numbers::pi * uniform_.next_fraction());
  }

 private:
  simulate::RandomNumbers uniform_;
};

/// Parameter of line `k` of `count`.
double parameter_of(const SamplePlan& plan, std::uint32_t k, std::uint32_t count) {
  if (count == 1) return (plan.low + plan.high) / 2;
  const double part = static_cast<double>(k) / (count - 1);
  return (1 - part) * plan.low + part * plan.high;
}

/// On its trim loops too: a place is looked at a little further inside of the patch.
bool in_face(const Surface& surface, const SurfacePlace& place) {
  constexpr double kInward = 1e-9;
  const SurfacePlace inside{place.span, place.u + kInward * (0.5 - place.u), place.v + kInward * (0.5 - place.v)};
  return inside_face(surface.image(), inside);
}

ProbePoint sample(const Surface& surface, const SurfacePlace& place, const SamplePlan& plan, NormalNumbers& noise) {
  const SurfacePoint at = surface.evaluate(place);
  const Vec3 normal = surface.normal(place, at);
  const double height = plan.offset_mm + (plan.noise_mm > 0 ? plan.noise_mm * noise.next() : 0.0);
  const Vec3 position = apply(plan.pose, at.s + height * normal);
  const Vec3 approach = plan.directions ? Vec3(-(plan.pose.rotation * normal)) : Vec3(Vec3::Zero());
  ProbePoint point;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    point.position[static_cast<std::size_t>(axis)] = position[axis];
    point.approach[static_cast<std::size_t>(axis)] = approach[axis];
  }
  return point;
}

}  // namespace

std::vector<ProbePoint> sample_surface(const DesignImage& design, const SamplePlan& plan) {
  const Surface surface(design);
  NormalNumbers noise(plan.seed);
  const std::uint32_t lines = plan.lines_along_v ? plan.count_u : plan.count_v;
  const std::uint32_t steps = plan.lines_along_v ? plan.count_v : plan.count_u;
  const std::uint32_t first = plan.patch.value_or(0);
  const std::uint32_t end = plan.patch ? first + 1 : static_cast<std::uint32_t>(design.patches().size());
  std::vector<ProbePoint> points;
  std::uint16_t path = 0;
  for (std::uint32_t patch = first; patch < end; ++patch) {
    for (std::uint32_t line = 0; line < lines; ++line) {
      ++path;
      for (std::uint32_t step = 0; step < steps; ++step) {
        const double u = parameter_of(plan, plan.lines_along_v ? line : step, plan.count_u);
        const double v = parameter_of(plan, plan.lines_along_v ? step : line, plan.count_v);
        const SurfacePlace place = surface.place_at(patch, u, v);
        if (!in_face(surface, place)) continue;
        points.push_back(sample(surface, place, plan, noise));
        points.back().path = path;
        points.back().sequence = static_cast<std::uint32_t>(points.size());
      }
    }
  }
  return points;
}

}  // namespace bladefit
