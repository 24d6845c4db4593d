#include "tools/doctor/design_match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/nearest/global_projection.hpp"
#include "core/geometry/surface/design_image.hpp"
#include "tools/batch/outliers.hpp"
#include "tools/search/pose_search.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kLooks = 25;
constexpr double kNowhere = std::numeric_limits<double>::infinity();
/// [half diagonals] Points whose median distance from the surface is no larger lie on it.
constexpr double kOnSurface = 0.02;
/// A larger factor wins where the distances, each against the size of the points, are this share: small factors bring
/// any points to one place.
constexpr double kFarBetter = 0.1;
/// Share of the directions that face the surface below which they are taken for averted.
constexpr double kAvertedShare = 0.1;

Vec3 placed(const PlacedDesign& design, const ProbePoint& point, double factor) {
  return apply(design.start, factor * Vec3(point.position.data()));
}

double median_distance(const PlacedDesign& design, const std::vector<ProbePoint>& points, double factor) {
  std::vector<double> distances;
  for (const ProbePoint& point : points) {
    const ProjectionQuery query{placed(design, point, factor)};
    const double distance = std::sqrt(project_global(design.surface, query, nullptr).nearest.distance_squared());
    distances.push_back(std::abs(distance - design.probe_radius_mm));
  }
  return median(std::move(distances));
}

/// Whether the probing directions run out of the material at the nearest places. Without directions: no.
bool runs_out(const PlacedDesign& design, const std::vector<ProbePoint>& points, double factor) {
  std::size_t directed = 0, facing = 0;
  for (const ProbePoint& point : points) {
    const Vec3 approach = design.start.rotation * Vec3(point.approach.data());
    if (approach.squaredNorm() == 0) continue;
    ++directed;
    const Projection nearest =
        project_global(design.surface, ProjectionQuery{placed(design, point, factor)}, nullptr).nearest;
    facing += faces_probe(design.surface, nearest, approach) ? 1 : 0;
  }
  return directed >= kLeastPoints && static_cast<double>(facing) <= kAvertedShare * static_cast<double>(directed);
}

std::string box_words(const Vec3& low, const Vec3& high) {
  return fmt::format("x {:.3f} to {:.3f}, y {:.3f} to {:.3f}, z {:.3f} to {:.3f} mm", low.x(), high.x(), low.y(),
                     high.y(), low.z(), high.z());
}

}  // namespace

DesignMatch match_design(const PlacedDesign& design, const std::vector<ProbePoint>& points) {
  const std::vector<ProbePoint> looks = some_of(points, kLooks);
  const double near_mm = kOnSurface * design.surface.half_diagonal();
  DesignMatch match;
  match.median_mm = median_distance(design, looks, 1);
  match.lies_on = match.median_mm <= near_mm;
  for (const double factor : kFactors) {
    if (match.lies_on && factor < match.factor) continue;
    const double distance = median_distance(design, looks, factor);
    const bool far_better = distance / factor < kFarBetter * match.median_mm / match.factor;
    if (distance > near_mm || (match.lies_on && !far_better)) continue;
    match = {.lies_on = true, .factor = factor, .median_mm = distance};
  }
  match.averted = match.lies_on && runs_out(design, looks, match.factor);
  return match;
}

std::string box_text(const std::vector<ProbePoint>& points) {
  Vec3 low = Vec3::Constant(kNowhere), high = -low;
  for (const ProbePoint& point : points) {
    low = low.cwiseMin(Vec3(point.position.data()));
    high = high.cwiseMax(Vec3(point.position.data()));
  }
  return box_words(low, high);
}

std::string box_text(const PlacedDesign& design) {
  const ImageHeader& header = design.surface.image().header();
  const Pose& start = design.start;
  Vec3 low = Vec3::Constant(kNowhere), high = -low;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec3 at;
    for (unsigned axis = 0; axis < 3; ++axis)
      at[axis] = (corner >> axis & 1U) != 0 ? header.box_max[axis] : header.box_min[axis];
    const Vec3 machine = start.rotation.transpose() * (at - start.translation);
    low = low.cwiseMin(machine);
    high = high.cwiseMax(machine);
  }
  return box_words(low, high);
}

}  // namespace bladefit
