// Sides of a patch that are one point: the nearest point and its proof about such a pole, against samples that are
// refined without derivatives. Points of each shape by BLADEFIT_POLE_POINTS (default 400).

#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>
#include <random>

#include "core/geometry/nearest/global_projection.hpp"
#include "tests/support/compiled_design.hpp"
#include "tests/support/made_surface.hpp"
#include "tests/support/random_places.hpp"
#include "tools/design/image/image_writer.hpp"

namespace bladefit::testing {
namespace {

constexpr double kOff = 1e-9;  ///< no foot is farther than the nearest by more than this [half diagonals]

/// Samples of every patch, closer together towards its sides, and from each that is nearer than its neighbours a search
/// that takes what is nearer and halves its steps.
class SampledDistance {
 public:
  explicit SampledDistance(const Surface& surface) : surface_(surface) {
    for (int k = 0; k <= kHalf; ++k) steps_.push_back(0.5 * std::pow(k / static_cast<double>(kHalf), 3));
    for (int k = kHalf - 1; k >= 0; --k) steps_.push_back(1.0 - steps_[static_cast<std::size_t>(k)]);
    const auto patches = static_cast<std::uint32_t>(surface.image().patches().size());
    for (std::uint32_t patch = 0; patch < patches; ++patch) {
      for (const double u : steps_) {
        for (const double v : steps_) samples_.push_back(point(patch, u, v));
      }
    }
  }

  [[nodiscard]] double least(const Vec3& r) const {
    const std::size_t n = steps_.size();
    double least = INFINITY;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      const std::size_t i = k / n % n, j = k % n;
      const double here = (samples_[k] - r).squaredNorm();
      const bool nearer = (i == 0 || here <= (samples_[k - n] - r).squaredNorm()) &&
                          (i + 1 == n || here <= (samples_[k + n] - r).squaredNorm()) &&
                          (j == 0 || here <= (samples_[k - 1] - r).squaredNorm()) &&
                          (j + 1 == n || here <= (samples_[k + 1] - r).squaredNorm());
      if (nearer) least = std::min(least, refined(r, static_cast<std::uint32_t>(k / (n * n)), steps_[i], steps_[j]));
    }
    return least;
  }

 private:
  static constexpr int kHalf = 12, kMostSteps = 150;

  [[nodiscard]] Vec3 point(std::uint32_t patch, double u, double v) const {
    return surface_.evaluate(surface_.place_at(patch, u, v)).s;
  }

  [[nodiscard]] double refined(const Vec3& r, std::uint32_t patch, double u, double v) const {
    double least = (point(patch, u, v) - r).norm();
    double step = 0.1;
    for (int k = 0; k < kMostSteps && step > 1e-10; ++k) {
      const double before = least, from_u = u, from_v = v;
      for (int way = 0; way < 8; ++way) {
        const double angle = 0.25 * std::numbers::pi * way;
        const double a = std::clamp(from_u + step * std::cos(angle), 0.0, 1.0);
        const double b = std::clamp(from_v + step * std::sin(angle), 0.0, 1.0);
        const double there = (point(patch, a, b) - r).norm();
        if (there >= least) continue;
        least = there;
        u = a;
        v = b;
      }
      if (!(least < before)) step *= 0.5;
    }
    return least;
  }

  const Surface& surface_;
  std::vector<double> steps_;
  std::vector<Vec3> samples_;
};

enum class Collapse : std::uint8_t { low_u, high_u, low_v, high_v };

/// Moves the control points of a side to the mean of them.
NurbsSurface collapsed(NurbsSurface surface, Collapse side) {
  const int nu = surface.u.control_points, nv = surface.v.control_points;
  const bool along_v = side == Collapse::low_u || side == Collapse::high_u;
  const int count = along_v ? nv : nu;
  const auto index = [&](int k) {
    const int i = along_v ? (side == Collapse::low_u ? 0 : nu - 1) : k;
    const int j = along_v ? k : (side == Collapse::low_v ? 0 : nv - 1);
    return static_cast<std::size_t>(i * nv + j);
  };
  Vec3 mean = Vec3::Zero();
  for (int k = 0; k < count; ++k) mean += surface.control_points[index(k)] / count;
  for (int k = 0; k < count; ++k) surface.control_points[index(k)] = mean;
  return surface;
}

SurfaceDirection arcs(int quarters) {
  SurfaceDirection direction{2, 2 * quarters + 1, {0, 0, 0}, 0.0, 1.0};
  for (int k = 1; k <= quarters; ++k) direction.knots.insert(direction.knots.end(), k < quarters ? 2 : 3, k);
  direction.end = quarters;
  return direction;
}

/// Half of an ellipsoid, 50 x 40 x 30 mm its half axes, or a cone on the same base, from its pole at u = 0 down;
/// `quarters` of it about the axis from the quarter `first` on.
NurbsSurface dome(int quarters, int first, bool cone) {
  NurbsSurface surface;
  surface.name = "dome";
  surface.u = arcs(1);
  surface.v = arcs(quarters);
  const double half = std::sqrt(0.5);
  const std::vector<std::pair<double, double>> meridian =
      cone ? std::vector<std::pair<double, double>>{{0, 1}, {0.5, 0.5}, {1, 0}}
           : std::vector<std::pair<double, double>>{{0, 1}, {1, 1}, {1, 0}};
  for (const auto& [radius, height] : meridian) {
    for (int k = 0; k <= 2 * quarters; ++k) {
      const double angle = 0.25 * std::numbers::pi * (k + 2 * first), out = k % 2 == 0 ? radius : radius / half;
      surface.control_points.emplace_back(50 * out * std::cos(angle), 40 * out * std::sin(angle), 30 * height);
      const bool middle = radius == meridian[1].first && height == meridian[1].second;
      surface.weights.push_back((middle ? half : 1.0) * (k % 2 == 0 ? 1.0 : half));
    }
  }
  return surface;
}

/// Both sides of a cap between two curves that meet at either end.
NurbsSurface cap() {
  NurbsSurface surface;
  surface.u = {4, 5, {0, 0, 0, 0, 0, 1, 1, 1, 1, 1}, 0.0, 1.0};
  surface.v = {1, 2, {0, 0, 1, 1}, 0.0, 1.0};
  const std::vector<double> y = {0, -3, -3, -3, 0};
  for (int k = 0; k < 5; ++k) {
    surface.control_points.emplace_back(10.0 * k - 20.0, y[static_cast<std::size_t>(k)], 0.0);
    surface.control_points.emplace_back(10.0 * k - 20.0, k % 4 == 0 ? 0.0 : 3.0, k % 4 == 0 ? 0.0 : 1.0);
  }
  surface.weights.assign(10, 1.0);
  return surface;
}

std::vector<NurbsSurface> shape(int index) {
  const DirectionPlan cubic{3, 3}, plain{2, 1};
  switch (index) {
    case 0:
      return {cap()};
    case 1:
      return {dome(4, 0, false)};
    case 2:
      return {dome(2, 0, false), dome(2, 2, false)};
    case 3:
      return {dome(4, 0, true)};
    case 4:
      return {dome(3, 0, true), dome(1, 3, true)};
    default: {
      const auto seed = static_cast<std::uint32_t>(index);
      const auto side = static_cast<Collapse>(index % 4);
      return {collapsed(random_surface(index % 3 == 0 ? plain : cubic, cubic, index % 2 == 0, seed), side)};
    }
  }
}

/// A pole of the design: where a side of a patch is one point.
SurfacePlace pole_of(const Surface& surface, std::uint32_t patch) {
  for (const auto& [u, v] : {std::pair{0.0, 0.3}, {1.0, 0.3}, {0.3, 0.0}, {0.3, 1.0}}) {
    const SurfacePlace place = surface.place_at(patch, u, v);
    const SurfacePoint at = surface.evaluate(place);
    if (std::min(at.s_u.norm(), at.s_v.norm()) < 1e-9) return place;
  }
  throw std::logic_error("no pole");
}

double power(std::mt19937_64& random, double least, double most) {
  return std::pow(10.0, uniform(random, least, most));
}

/// At a pole, about it, over the surface near to it, or anywhere.
Vec3 point_near_pole(const Surface& surface, std::mt19937_64& random) {
  const double size = surface.half_diagonal();
  const auto patch = static_cast<std::uint32_t>(random() % surface.image().patches().size());
  SurfacePlace place = pole_of(surface, patch);
  const SurfacePoint pole = surface.evaluate(place);
  const std::uint64_t kind = random() % 5;
  if (kind == 0) return pole.s;
  if (kind == 1) return pole.s + size * power(random, -10, 0) * random_direction_in_space(random);
  if (kind == 2) return pole.s + size * uniform(random, 0, 2) * random_direction_in_space(random);
  const double in = power(random, -9, -0.3);
  const bool along_v = pole.s_v.norm() < pole.s_u.norm();
  double& away = along_v ? place.u : place.v;
  away = away < 0.5 ? in : 1.0 - in;
  (along_v ? place.v : place.u) = uniform(random, 0, 1);
  surface.settle(place);
  const SurfacePoint at = surface.evaluate(place);
  const double height = size * power(random, -9, -1.5) * (random() % 2 == 0 ? 1.0 : -1.0);
  return kind == 3 ? at.s : Vec3(at.s + height * surface.normal(place, at));
}

int points_of_each() {
  const char* text = std::getenv("BLADEFIT_POLE_POINTS");
  return text != nullptr ? std::atoi(text) : 400;
}

class CollapsedSide : public ::testing::TestWithParam<int> {
 protected:
  CollapsedSide() : design_(write_image(shape(GetParam()), DesignUnit::mm, 1)), surface_(design_.surface()) {}

  CompiledDesign design_;
  const Surface& surface_;
};

TEST_P(CollapsedSide, FeetAreNearestAndProven) {
  const SampledDistance sampled(surface_);
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()) + 1);
  const double size = surface_.half_diagonal();
  int wrong = 0, unproven = 0, off = 0;
  std::uint32_t most = 0;
  for (int k = 0; k < points_of_each(); ++k) {
    const Vec3 r = point_near_pole(surface_, random);
    const GlobalProjection found = project_global(surface_, {r}, nullptr);
    const Projection& foot = found.nearest;
    most = std::max(most, found.pieces);
    if (!found.proven) ++unproven;
    if (!((surface_.evaluate(foot.place).s - foot.at.s).norm() <= kOff * size)) ++off;
    if (!((r - foot.at.s - foot.offset).norm() <= kOff * size)) ++off;
    if (!(foot.offset.norm() <= sampled.least(r) + kOff * size)) ++wrong;
  }
  std::printf("[ figures  ] shape %d: at most %u pieces\n", GetParam(), most);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(unproven, 0);
  EXPECT_EQ(off, 0);
}

/// With a margin, and from any hint.
TEST_P(CollapsedSide, MarginIsProvenAndHintsChangeNothing) {
  std::mt19937_64 random(static_cast<std::uint64_t>(GetParam()) + 1000);
  const double size = surface_.half_diagonal(), margin = 2e-3 * size;
  int unproven = 0, other = 0, nearer = 0;
  std::uint32_t most = 0;
  for (int k = 0; k < points_of_each(); ++k) {
    const Vec3 r = point_near_pole(surface_, random);
    const Projection hint = project_local(surface_, r, random_place(surface_, random));
    const GlobalProjection plain = project_global(surface_, {r}, nullptr);
    const GlobalProjection found = project_global(surface_, {r, Vec3::Zero(), margin}, &hint);
    most = std::max(most, found.pieces);
    if (!found.proven) ++unproven;
    if (!(std::abs(found.nearest.offset.norm() - plain.nearest.offset.norm()) <= kOff * size)) ++other;
    // Moved by less than half the margin, what is tracked stays the nearest.
    const Vec3 there = r + uniform(random, 0, 0.4999) * found.runner_up.margin * random_direction_in_space(random);
    const Projection tracked = project_local(surface_, there, found.nearest.place);
    if (!tracked.converged || tracked.fixed_u || tracked.fixed_v || tracked.at_pole) continue;
    const double least = project_global(surface_, {there}, nullptr).nearest.offset.norm();
    if (tracked.offset.norm() > least + kOff * size) ++nearer;
  }
  std::printf("[ figures  ] shape %d: at most %u pieces\n", GetParam(), most);
  EXPECT_EQ(other, 0);
  // About a centre of curvature minima are born, and a margin cannot always be proven.
  EXPECT_LE(200 * nearer, points_of_each());
  EXPECT_LE(100 * unproven, points_of_each());
}

INSTANTIATE_TEST_SUITE_P(Shapes, CollapsedSide, ::testing::Range(0, 13));

}  // namespace
}  // namespace bladefit::testing
