#include "tests/support/touching_balls.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "core/geometry/nearest/global_projection.hpp"
#include "core/geometry/nearest/reach.hpp"
#include "core/geometry/surface/trim.hpp"
#include "tests/support/random_places.hpp"

namespace bladefit::testing {
namespace {

constexpr int kNodesPerSpan = 4;
/// A search is exact to within this [half diagonals].
constexpr double kExact = 1e-9;
/// How far beyond a foot other local minima are looked for [half diagonals].
constexpr double kMargin = 4e-3;

std::vector<Vec3> grid_over(const Surface& surface) {
  std::vector<Vec3> nodes;
  for (std::uint32_t span = 0; span < surface.image().spans().size(); ++span) {
    const SpanDomain d = surface.domain(span);
    for (int k = 0; k < kNodesPerSpan * kNodesPerSpan; ++k) {
      const double s = (0.5 + k / kNodesPerSpan) / kNodesPerSpan, t = (0.5 + k % kNodesPerSpan) / kNodesPerSpan;
      const SurfacePlace place{span, d.u_min + s * (d.u_max - d.u_min), d.v_min + t * (d.v_max - d.v_min)};
      if (inside_face(surface.image(), place)) nodes.push_back(surface.evaluate(place).s);
    }
  }
  return nodes;
}

class BallCheck {
 public:
  explicit BallCheck(const Surface& surface) : surface_(surface), nodes_(grid_over(surface)) {}

  void try_ball(std::mt19937_64& random, TouchingBalls& out) const {
    ++out.tried;
    Projection foot;
    foot.place = random_place(surface_, random);
    foot.at = surface_.evaluate(foot.place);
    foot.converged = true;
    const std::size_t side = random() % 2;
    const auto reach = static_cast<double>(surface_.span(foot.place.span).reach[side]);
    if (!(reach > 0.0) || !inside_face(surface_.image(), foot.place)) return;
    foot.offset = 0.5 * reach * (side == 0 ? 1.0 : -1.0) * foot.at.s_u.cross(foot.at.s_v).normalized();
    if (!proof_by_reach(surface_, foot).nearest) return;
    const double radius = random() % 2 == 0 ? 0.999999 * reach : reach * uniform(random, 0, 1);
    const Vec3 normal = foot.at.s_u.cross(foot.at.s_v).normalized();
    foot.offset = (side == 0 ? radius : -radius) * normal;
    ++out.tested;
    judge(foot, radius, out);
  }

 private:
  void judge(const Projection& foot, double radius, TouchingBalls& out) const {
    const Vec3 centre = foot.at.s + foot.offset;
    const double size = surface_.half_diagonal(), least = radius - kExact * size;
    bool held = false;
    for (const Vec3& node : nodes_) held = held || (node - centre).squaredNorm() < least * least;
    const GlobalProjection found = project_global(surface_, {centre, Vec3::Zero(), kMargin * size}, &foot);
    held = held || (found.proven && found.nearest.offset.norm() < least);
    if (held) note(foot, radius, "is not empty", out.held, out);
    const ReachProof proof = proof_by_reach(surface_, foot);
    const double margin = std::min(proof.margin, kMargin * size) - kExact * size;
    if (proof.nearest && found.proven && found.runner_up.margin < margin)
      note(foot, radius, "has another local minimum near to its foot", out.rivals, out);
  }

  static void note(const Projection& foot, double radius, const char* what, std::size_t& count, TouchingBalls& out) {
    ++count;
    if (out.first.empty())
      out.first = fmt::format("a ball of {} mm at u {} v {} of span {} {}", radius, foot.place.u, foot.place.v,
                              foot.place.span, what);
  }

  const Surface& surface_;
  std::vector<Vec3> nodes_;
};

}  // namespace

TouchingBalls touching_balls(const Surface& surface, std::size_t count, std::uint64_t seed) {
  const BallCheck check(surface);
  std::mt19937_64 random(seed);
  TouchingBalls out;
  for (std::size_t k = 0; k < count; ++k) check.try_ball(random, out);
  return out;
}

std::size_t balls_asked(std::size_t usual) {
  const char* const text = std::getenv("BLADEFIT_BALLS");
  return text == nullptr ? usual : static_cast<std::size_t>(std::strtoul(text, nullptr, 10));
}

}  // namespace bladefit::testing
