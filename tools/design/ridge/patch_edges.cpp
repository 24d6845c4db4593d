#include "tools/design/ridge/patch_edges.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/surface/joint.hpp"

namespace bladefit {
namespace {

/// Cosine of the angle up to which two edges run in the same direction.
constexpr double kAlong = 0.7;

/// Low and high sides alternate.
std::size_t opposite_of(std::size_t edge) { return edge ^ 1U; }

std::pair<double, double> parameters_of(const EdgePlace& place) {
  const bool low = place.edge == kLowU || place.edge == kLowV;
  const double side = low ? 0.0 : 1.0;
  const bool constant_u = place.edge == kLowU || place.edge == kHighU;
  return constant_u ? std::pair{side, place.t} : std::pair{place.t, side};
}

}  // namespace

PatchEdges::PatchEdges(const Surface& surface) : surface_(surface), gap_(joint_gap(surface.half_diagonal())) {
  edges_.resize(surface.image().patches().size());
  for (std::uint32_t patch = 0; patch < edges_.size(); ++patch) {
    for (std::size_t edge = 0; edge < 4; ++edge) {
      Edge& own = edges_[patch].at(edge);
      for (std::size_t k = 0; k <= kSamples; ++k) {
        own.points.at(k) = point_on({patch, edge, static_cast<double>(k) / kSamples});
        own.box.extend(own.points.at(k));
      }
    }
  }
}

Vec3 PatchEdges::point_on(const EdgePlace& place) const {
  const auto [u, v] = parameters_of(place);
  return surface_.evaluate(surface_.place_at(place.patch, u, v)).s;
}

Vec3 PatchEdges::direction_of(const EdgePlace& place) const {
  const auto [u, v] = parameters_of(place);
  const SurfacePoint point = surface_.evaluate(surface_.place_at(place.patch, u, v));
  return place.edge == kLowU || place.edge == kHighU ? point.s_v : point.s_u;
}

std::pair<EdgePlace, double> PatchEdges::nearest_on(std::uint32_t patch, std::size_t edge, const Vec3& point) const {
  const auto& points = edges_[patch].at(edge).points;
  const auto distance_of = [&point](const Vec3& other) { return (other - point).squaredNorm(); };
  const auto best = std::ranges::min_element(points, {}, distance_of) - points.begin();
  const double middle = static_cast<double>(best) / kSamples;
  double low = std::max(0.0, middle - 1.0 / kSamples), high = std::min(1.0, middle + 1.0 / kSamples);
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  const auto at = [&](double t) { return distance_of(point_on({patch, edge, t})); };
  for (int k = 0; k < 40; ++k) {  // golden section
    const double third = high - ratio * (high - low), other = low + ratio * (high - low);
    (at(third) < at(other) ? high : low) = at(third) < at(other) ? other : third;
  }
  // The end of an edge is a place of its own, which a section never quite reaches.
  double t = 0.5 * (low + high);
  for (const double end : {0.0, 1.0}) {
    if (std::abs(t - end) < 1e-6 && at(end) <= at(t)) t = end;
  }
  return {EdgePlace{patch, edge, t}, std::sqrt(at(t))};
}

std::optional<EdgePlace> PatchEdges::beyond(const EdgePlace& place) const {
  const Vec3 point = point_on(place), direction = direction_of(place);
  if (!(direction.norm() > 0.0)) return std::nullopt;
  std::optional<EdgePlace> found;
  double best = kAlong;
  for (std::uint32_t patch = 0; patch < edges_.size(); ++patch) {
    for (std::size_t edge = 0; edge < 4; ++edge) {
      if (patch == place.patch && edge != opposite_of(place.edge)) continue;
      const double reach = edges_[patch].at(edge).box.diagonal().norm() / kSamples + gap_;
      if (edges_[patch].at(edge).box.exteriorDistance(point) > reach) continue;
      const auto [other, distance] = nearest_on(patch, edge, point);
      const Vec3 along = direction_of(other);
      if (distance > gap_ || !(along.norm() > 0.0)) continue;
      const double cosine = std::abs(along.dot(direction)) / (along.norm() * direction.norm());
      if (cosine <= best) continue;
      best = cosine;
      found = other;
    }
  }
  return found;
}

}  // namespace bladefit
