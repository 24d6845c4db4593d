#include "tools/search/pose_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tools/search/coarse_fit.hpp"
#include "tools/search/even_rotations.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kSamples = 6000, kRotations = 600;
/// Points that the first, and the second, coarse fits look at.
constexpr std::size_t kFirstPoints = 40, kSecondPoints = kSearchPoints;
/// Starts that are kept after the first coarse fits.
constexpr std::size_t kKept = 160;
/// Places of the design to which the middle of the points is brought, beside that of the design: few where the points
/// span the whole of it.
constexpr double kLeastSites = 4, kMostSites = 40;
/// Points that tell whether two poses are the same.
constexpr std::size_t kPoints = 12;
/// Reach of the coarse fits, and how far apart two poses bring the points that are not the same [half diagonals].
constexpr double kFirstReach = 0.5, kSecondReach = 0.12, kSamePose = 0.03, kSameFit = 0.004;

std::vector<Vec3> positions_of(const std::vector<ProbePoint>& points) {
  std::vector<Vec3> out;
  out.reserve(points.size());
  for (const ProbePoint& point : points) out.emplace_back(point.position.data());
  return out;
}

Vec3 mean_of(const std::vector<Vec3>& points) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& point : points) mean += point;
  return mean / static_cast<double>(points.size());
}

std::vector<Vec3> thinned(const std::vector<Vec3>& points, std::size_t count) {
  if (points.size() <= count) return points;
  std::vector<Vec3> out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(points[k * points.size() / count]);
  return out;
}

}  // namespace

std::vector<ProbePoint> some_of(const std::vector<ProbePoint>& points, std::size_t count) {
  if (points.size() <= count) return points;
  std::vector<ProbePoint> out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(points[k * points.size() / count]);
  return out;
}

double apart(const std::vector<ProbePoint>& points, const Pose& a, const Pose& b) {
  double square = 0;
  for (const ProbePoint& point : points) {
    const Vec3 at(point.position.data());
    square += (apply(a, at) - apply(b, at)).squaredNorm();
  }
  return std::sqrt(square / static_cast<double>(std::max<std::size_t>(points.size(), 1)));
}

PoseSearch::PoseSearch(const DesignImage& design, const LocalizerConfig& config)
    : design_(design),
      config_(config),
      samples_(sample_design(Surface(design), kSamples, config.probe_radius_mm)),
      grid_(samples_) {}

/// Places of the design for the middle of the points: its own middle, and samples that are far from each other.
std::vector<Vec3> PoseSearch::sites(const std::vector<Vec3>& points) const {
  const double share = std::max(extent_of(points) / samples_.extent_mm, 1e-3);
  const auto wanted = static_cast<std::size_t>(std::clamp(2.0 / (share * share), kLeastSites, kMostSites)) + 1;
  std::vector<Vec3> out = {samples_.centre};
  std::vector<double> square(samples_.samples.size(), std::numeric_limits<double>::infinity());
  while (out.size() < wanted) {
    std::size_t farthest = 0;
    for (std::size_t k = 0; k < square.size(); ++k) {
      square[k] = std::min(square[k], (samples_.samples[k].point - out.back()).squaredNorm());
      if (square[k] > square[farthest]) farthest = k;
    }
    out.push_back(samples_.samples[farthest].point);
  }
  return out;
}

std::vector<PoseSearch::Start> PoseSearch::coarse_starts(const std::vector<Vec3>& points) const {
  const std::vector<Vec3> some = thinned(points, kFirstPoints);
  const Vec3 middle = mean_of(points);
  const std::vector<Vec3> places = sites(points);
  const double reach = kFirstReach * samples_.half_diagonal_mm;
  std::vector<Start> starts;
  for (const Mat3& rotation : even_rotations(kRotations)) {
    for (const Vec3& place : places) {
      Start start{{rotation, place - rotation * middle}, 0};
      fit_coarsely(grid_, some, {.steps = 8, .reach_mm = reach}, start.pose);
      start.misfit =
          coarse_misfit(grid_, some, start.pose, kSecondReach * samples_.half_diagonal_mm, samples_.spacing_mm);
      starts.push_back(start);
    }
  }
  return starts;
}

void PoseSearch::improve(const std::vector<Vec3>& points, std::vector<Start>& starts) const {
  const double reach = kSecondReach * samples_.half_diagonal_mm;
  for (Start& start : starts) {
    fit_coarsely(grid_, points, {.steps = 12, .reach_mm = reach, .tangential = 0.02}, start.pose);
    start.misfit = coarse_misfit(grid_, points, start.pose, reach, samples_.spacing_mm);
  }
}

namespace {

/// The best of the candidates, at most `count`, no two within `same_mm` of each other.
template <class Candidate, class Value>
std::vector<Candidate> best_of(std::vector<Candidate> all, const std::vector<ProbePoint>& points, std::size_t count,
                               double same_mm, Value value) {
  const std::vector<ProbePoint> some = some_of(points, kPoints);
  std::stable_sort(all.begin(), all.end(),
                   [&value](const Candidate& a, const Candidate& b) { return value(a) < value(b); });
  std::vector<Candidate> best;
  for (const Candidate& candidate : all) {
    const bool known = std::any_of(best.begin(), best.end(), [&](const Candidate& other) {
      return apart(some, candidate.pose, other.pose) < same_mm;
    });
    if (!known) best.push_back(candidate);
    if (best.size() == count) break;
  }
  return best;
}

}  // namespace

std::vector<PoseFit> PoseSearch::poses_of(const std::vector<ProbePoint>& all) const {
  if (all.size() < 6) return {};
  const std::vector<ProbePoint> points = some_of(all, kSearchPoints);
  const std::vector<Vec3> positions = positions_of(points);
  const auto misfit = [](const Start& start) { return start.misfit; };
  const double same = kSamePose * samples_.half_diagonal_mm;
  std::vector<Start> starts = best_of(coarse_starts(positions), points, kKept, same, misfit);
  improve(positions, starts);
  starts = best_of(starts, points, kMostPoses, same, misfit);
  std::vector<PoseFit> fits;
  fits.reserve(starts.size());
  for (const Start& start : starts) fits.push_back(fit_candidate(design_, config_, points, start.pose));
  return best_of(fits, points, kMostPoses, kSameFit * samples_.half_diagonal_mm,
                 [](const PoseFit& fit) { return std::pair(fit.is_averted(), fit.typical_mm); });
}

}  // namespace bladefit
