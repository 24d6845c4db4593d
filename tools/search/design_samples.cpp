#include "tools/search/design_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bladefit {
namespace {

/// Lines on which a patch's directions are measured, and intervals of each.
constexpr std::size_t kLines = 7, kIntervals = 96;
constexpr std::size_t kLeastLines = 3, kMostLines = 400;
/// Sweeps to the farthest point: each ends no nearer than the one before.
constexpr int kFarthestSweeps = 4;

/// Length along one direction of a patch from its beginning to each end of an interval, the longest of the lines.
struct Lengths {
  std::array<double, kIntervals + 1> to{};

  [[nodiscard]] double total() const { return to.back(); }
  /// The parameter at a share of the length.
  [[nodiscard]] double parameter(double share) const {
    const double wanted = share * total();
    const auto above = std::upper_bound(to.begin() + 1, to.end() - 1, wanted);
    const auto k = static_cast<std::size_t>(above - to.begin()) - 1;
    const double step = to[k + 1] - to[k], part = step > 0.0 ? (wanted - to[k]) / step : 0.0;
    return std::clamp((static_cast<double>(k) + part) / kIntervals, 0.0, 1.0);
  }
};

Vec3 at(const Surface& surface, std::uint32_t patch, double u, double v) {
  return surface.evaluate(surface.place_at(patch, u, v)).s;
}

Lengths lengths_of(const Surface& surface, std::uint32_t patch, bool along_u) {
  Lengths lengths;
  std::array<Vec3, kLines> before;
  for (std::size_t k = 0; k <= kIntervals; ++k) {
    double longest = 0;
    for (std::size_t line = 0; line < kLines; ++line) {
      const double t = static_cast<double>(k) / kIntervals, across = static_cast<double>(line) / (kLines - 1);
      const Vec3 point = along_u ? at(surface, patch, t, across) : at(surface, patch, across, t);
      if (k > 0) longest = std::max(longest, (point - before[line]).norm());
      before[line] = point;
    }
    if (k > 0) lengths.to[k] = lengths.to[k - 1] + longest;
  }
  return lengths;
}

struct PatchLengths {
  Lengths u, v;
};

std::size_t lines_of(double length, double spacing) {
  return std::clamp(static_cast<std::size_t>(length / spacing) + 1, kLeastLines, kMostLines);
}

void sample_patch(const Surface& surface, std::uint32_t patch, const PatchLengths& lengths, double offset_mm,
                  DesignSamples& out) {
  const std::size_t count_u = lines_of(lengths.u.total(), out.spacing_mm);
  const std::size_t count_v = lines_of(lengths.v.total(), out.spacing_mm);
  for (std::size_t i = 0; i < count_u; ++i) {
    const double u = lengths.u.parameter(static_cast<double>(i) / static_cast<double>(count_u - 1));
    for (std::size_t j = 0; j < count_v; ++j) {
      const double v = lengths.v.parameter(static_cast<double>(j) / static_cast<double>(count_v - 1));
      const SurfacePlace place = surface.place_at(patch, u, v);
      const SurfacePoint point = surface.evaluate(place);
      const Vec3 normal = surface.normal(place, point);
      out.samples.push_back({point.s + offset_mm * normal, normal, patch});
    }
  }
}

}  // namespace

double extent_of(const std::vector<Vec3>& points) {
  if (points.empty()) return 0.0;
  Vec3 from = points.front();
  double extent = 0;
  for (int sweep = 0; sweep < kFarthestSweeps; ++sweep) {
    const auto far = std::max_element(points.begin(), points.end(), [&from](const Vec3& a, const Vec3& b) {
      return (a - from).squaredNorm() < (b - from).squaredNorm();
    });
    extent = std::max(extent, (*far - from).norm());
    from = *far;
  }
  return extent;
}

DesignSamples sample_design(const Surface& surface, std::size_t count, double offset_mm) {
  DesignSamples out;
  std::vector<PatchLengths> lengths;
  double area = 0;
  const auto patches = static_cast<std::uint32_t>(surface.image().patches().size());
  for (std::uint32_t patch = 0; patch < patches; ++patch) {
    lengths.push_back({lengths_of(surface, patch, true), lengths_of(surface, patch, false)});
    area += lengths.back().u.total() * lengths.back().v.total();
  }
  out.half_diagonal_mm = surface.half_diagonal();
  out.spacing_mm = std::sqrt(area / static_cast<double>(count));
  std::vector<Vec3> points;
  for (std::uint32_t patch = 0; patch < patches; ++patch) {
    sample_patch(surface, patch, lengths[patch], offset_mm, out);
  }
  for (const DesignSample& sample : out.samples) {
    points.push_back(sample.point);
    out.centre += sample.point;
  }
  out.centre /= static_cast<double>(out.samples.size());
  out.extent_mm = extent_of(points);
  return out;
}

}  // namespace bladefit
