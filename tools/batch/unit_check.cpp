#include "tools/batch/unit_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/text/units.hpp"
#include "tools/batch/credibility.hpp"

namespace bladefit {
namespace {

/// Factors between units that measuring programs and CAD systems write.
constexpr std::array<double, 5> kFactors = {kMmPerInch, 10, 1000, 304.8, 100};
/// Points that span more than this many times the design cannot be on it; that span less than this share may be in a
/// larger unit.
constexpr double kTooLarge = 1.3, kTooSmall = 0.3;
/// What the points must span of the design once their unit is right.
constexpr double kLeastShare = 0.25, kMostShare = 1.15;
/// A fit in another unit counts where its distances are this share of the best one as they are, each against the extent
/// of its points.
constexpr double kFarBetter = 0.34;
constexpr std::size_t kMostTrials = 3;

Vec3 position_of(const ProbePoint& point) { return Vec3(point.position.data()); }

std::vector<ProbePoint> divided(std::vector<ProbePoint> points, double factor) {
  for (ProbePoint& point : points) {
    for (double& x : point.position) x /= factor;
  }
  return points;
}

/// Largest possible distance of two places of the design.
double most_extent(const Surface& surface) { return 2.0 * surface.half_diagonal(); }

/// Factors that bring an extent to that of the design, the one with the fullest span first.
std::vector<double> plausible(double extent, double design_extent) {
  std::vector<double> factors;
  for (const double size : kFactors) {
    for (const double factor : {size, 1.0 / size}) {
      const double share = extent / factor / design_extent;
      if (share >= kLeastShare && share <= kMostShare) factors.push_back(factor);
    }
  }
  std::stable_sort(factors.begin(), factors.end(), [&](double a, double b) {
    return std::abs(std::log(extent / a / design_extent)) < std::abs(std::log(extent / b / design_extent));
  });
  if (factors.size() > kMostTrials) factors.resize(kMostTrials);
  return factors;
}

std::string number(double factor) { return fmt::format("{:.4g}", factor); }

/// The unit in which points that were taken in `unit` are not too large by the factor, where there is one.
std::string way_out(double factor, Unit unit) {
  for (const Unit other : {Unit::mm, Unit::inch, Unit::cm, Unit::metre}) {
    const double ratio = mm_per_unit(unit) / mm_per_unit(other);
    if (std::abs(factor / ratio - 1.0) < 1e-9) return fmt::format("give --units {}", word_of(other));
  }
  return "name their unit with --units, scale the points, or correct the unit of the design";
}

}  // namespace

double trimmed_extent(const std::vector<ProbePoint>& points) {
  if (points.empty()) return 0.0;
  std::array<double, 3> middle{};
  std::vector<double> values(points.size());
  const auto half = static_cast<std::ptrdiff_t>(points.size() / 2);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), values.begin(), [axis](const auto& p) { return p.position[axis]; });
    std::nth_element(values.begin(), values.begin() + half, values.end());
    middle[axis] = values[static_cast<std::size_t>(half)];
  }
  const Vec3 centre(middle.data());
  std::vector<Vec3> kept;
  kept.reserve(points.size());
  for (const ProbePoint& point : points) kept.push_back(position_of(point));
  std::sort(kept.begin(), kept.end(), [&centre](const Vec3& a, const Vec3& b) {
    return (a - centre).squaredNorm() < (b - centre).squaredNorm();
  });
  kept.resize(std::max<std::size_t>(1, kept.size() - kept.size() / 10));
  return extent_of(kept);
}

bool larger_than_design(const Surface& surface, const std::vector<ProbePoint>& points) {
  return trimmed_extent(points) > kTooLarge * most_extent(surface);
}

bool much_smaller_than_design(const Surface& surface, const std::vector<ProbePoint>& points) {
  return trimmed_extent(points) < kTooSmall * most_extent(surface);
}

std::optional<UnitFound> find_unit(const PoseSearch& search, const std::vector<ProbePoint>& points, double best_mm) {
  const double extent = trimmed_extent(points), design_extent = search.samples().extent_mm;
  const bool too_large = extent > kTooLarge * design_extent;
  const std::vector<double> factors = plausible(extent, design_extent);
  for (const double factor : factors) {
    const std::vector<PoseFit> fits = search.poses_of(divided(points, factor));
    if (fits.empty() || !is_credible(fits.front(), scale_of(search.samples(), extent / factor))) continue;
    if (fits.front().typical_mm * factor <= kFarBetter * best_mm) return UnitFound{factor, true};
  }
  if (!too_large) return std::nullopt;
  return UnitFound{factors.empty() ? extent / design_extent : factors.front(), false};
}

std::string unit_sentence(const UnitFound& found, Unit unit) {
  const bool large = found.factor > 1.0;
  const double times = large ? found.factor : 1.0 / found.factor;
  const std::string size =
      found.fits
          ? fmt::format("the points fit the design when they are {} by {}: they are {} times too {} for it",
                        large ? "divided" : "multiplied", number(times), number(times), large ? "large" : "small")
          : fmt::format("the points span more than the design can, about {} times its size", number(times));
  return fmt::format("{} (their numbers were taken as {}); {}", size, word_of(unit), way_out(found.factor, unit));
}

}  // namespace bladefit
