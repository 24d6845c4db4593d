#include "tools/batch/side_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/geometry/nearest/global_projection.hpp"
#include "tools/design/nurbs/outward_side.hpp"
#include "tools/search/pose_search.hpp"

namespace bladefit {
namespace {

/// Points that are looked at, and how many of them must have a direction that tells.
constexpr std::size_t kSideLooks = 60, kLeastLooks = 6;
/// A direction along the surface tells nothing: its cosine with the normal must be this large.
constexpr double kTells = 0.3;
/// Share of the directions that run out of the material where the side is the wrong one.
constexpr double kNearlyAll = 0.8;

/// Share of the directions that run out of the material; nothing where too few tell.
std::optional<double> share_outwards(const Surface& surface, const std::vector<ProbePoint>& points, const Pose& pose) {
  std::size_t told = 0, outwards = 0;
  for (const ProbePoint& point : points) {
    const Vec3 approach(point.approach.data());
    if (approach.squaredNorm() < 0.5) continue;
    const Projection foot = project_global(surface, {apply(pose, Vec3(point.position.data()))}, nullptr).nearest;
    const double cosine = surface.normal(foot.place, foot.at).dot(pose.rotation * approach);
    if (std::abs(cosine) < kTells) continue;
    ++told;
    if (cosine > 0.0) ++outwards;
  }
  if (told < kLeastLooks) return std::nullopt;
  return static_cast<double>(outwards) / static_cast<double>(told);
}

}  // namespace

std::string wrong_directions(const DesignImage& design, const FitPlan& plan, const std::vector<ProbePoint>& points,
                             const Pose& pose) {
  if (!plan.localizer.use_approach) return "";
  const std::optional<double> share = share_outwards(Surface(design), some_of(points, kSideLooks), pose);
  if (!share || *share < kNearlyAll) return "";
  return fmt::format(
      "at {:.0f} % of the points the probing direction runs out of the material: the outward side is the wrong one "
      "(--outward), or i,j,k run from the material to the probe; turn one of them round, or give --ignore-approach",
      100 * *share);
}

void check_outward(const DesignImage& design, const OutwardChoice& outward) {
  if (outward.all == OutwardOption::automatic) return;
  const std::optional<OutwardSide> shape = outward_side_of(Surface(design));
  const bool plus = outward.all == OutwardOption::plus;
  if (!shape || (shape->sign > 0) == plus) return;
  throw ToolError(fmt::format("--outward {}: {}; leave it out, or say --outward {}", plus ? "+" : "-", shape->reason,
                              plus ? "-" : "+"));
}

}  // namespace bladefit
