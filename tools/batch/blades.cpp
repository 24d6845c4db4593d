#include "tools/batch/blades.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

namespace bladefit {
namespace {

/// Places along each edge of a patch.
constexpr std::size_t kPlaces = 24;
/// Patches whose edges come as near as this are one body [half diagonals].
constexpr double kTouching = 2e-3;

/// The four edges of a patch as lines of points.
std::vector<Vec3> edges_of(const Surface& surface, std::uint32_t patch) {
  std::vector<Vec3> points;
  for (std::size_t k = 0; k <= kPlaces; ++k) {
    const double t = static_cast<double>(k) / kPlaces;
    for (const auto& [u, v] : {std::pair(t, 0.0), std::pair(t, 1.0), std::pair(0.0, t), std::pair(1.0, t)})
      points.push_back(surface.evaluate(surface.place_at(patch, u, v)).s);
  }
  return points;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (a + t * along - p).norm();
}

/// Whether two of the points on the edges of one patch lie on the edges of the other: a single one is a corner that
/// happens to be there.
bool touches(const std::vector<Vec3>& from, const std::vector<Vec3>& to, double near) {
  int found = 0;
  for (const Vec3& point : from) {
    for (std::size_t k = 4; k < to.size(); ++k) {
      if (distance_to_segment(point, to[k - 4], to[k]) > near) continue;
      if (++found == 2) return true;
      break;
    }
  }
  return false;
}

}  // namespace

Blades::Blades(const Surface& surface) {
  const auto patches = static_cast<std::uint32_t>(surface.image().patches().size());
  std::vector<std::vector<Vec3>> edges;
  for (std::uint32_t patch = 0; patch < patches; ++patch) edges.push_back(edges_of(surface, patch));
  std::vector<std::uint32_t> root(patches);
  std::iota(root.begin(), root.end(), 0U);
  const double near = kTouching * surface.half_diagonal();
  for (std::uint32_t a = 0; a < patches; ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      if (root[a] == root[b] || !(touches(edges[a], edges[b], near) || touches(edges[b], edges[a], near))) continue;
      const std::uint32_t low = std::min(root[a], root[b]), high = std::max(root[a], root[b]);
      std::replace(root.begin(), root.end(), high, low);
    }
  }
  for (std::uint32_t patch = 0; patch < patches; ++patch)
    blade_of_.push_back(root[patch] == patch ? ++count_ : blade_of_[root[patch]]);
}

std::string Blades::name_of(std::uint32_t blade) const {
  std::vector<std::uint32_t> patches;
  for (std::uint32_t patch = 0; patch < blade_of_.size(); ++patch) {
    if (blade_of_[patch] == blade) patches.push_back(patch);
  }
  if (patches.size() == 1) return fmt::format("blade {} (patch {})", blade, patches.front());
  const bool row = patches.back() - patches.front() + 1 == patches.size();
  if (row) return fmt::format("blade {} (patches {} to {})", blade, patches.front(), patches.back());
  return fmt::format("blade {} (patches {})", blade, fmt::join(patches, ", "));
}

}  // namespace bladefit
