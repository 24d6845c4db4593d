#include "tests/support/defect_patterns.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/owned_localizer.hpp"

namespace bladefit::testing {
namespace {

/// In 0..1, from the bits of the generator alone: the distributions of the library differ between makers.
double drawn(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

double drawn(std::mt19937_64& random, double low, double high) { return low + (high - low) * drawn(random); }

std::size_t drawn_below(std::mt19937_64& random, std::size_t count) {
  return static_cast<std::size_t>(random() % count);
}

double distance_between(const ProbePoint& a, const ProbePoint& b) {
  return (Vec3(a.position.data()) - Vec3(b.position.data())).norm();
}

/// The `count` points nearest to one of them, itself included.
std::vector<std::size_t> neighbours(const std::vector<ProbePoint>& points, std::size_t centre, std::size_t count) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const std::size_t kept = std::min(count, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end(),
                    [&](std::size_t a, std::size_t b) {
                      const double to_a = distance_between(points[a], points[centre]);
                      const double to_b = distance_between(points[b], points[centre]);
                      return to_a < to_b || (to_a == to_b && a < b);
                    });
  order.resize(kept);
  return order;
}

}  // namespace

DefectPatterns::DefectPatterns(const ReferenceCase& c, const std::string& subset) : case_(c) {
  points_ = subset == "all" ? thinned(c, 0, 1) : points_of(c, subset);
  LocalizerConfig config = config_of(c, points_.size());
  OwnedLocalizer fit(reference_design(c.name).image(), config);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    points_[i].sequence = static_cast<std::uint32_t>(i + 1);
    (void)fit->stage(points_[i]);
  }
  fit->conclude();
  (void)refine_fully(*fit);
  const FitReport report = fit->fit();
  rms_mm_ = report.rms_mm;
  for (ProbePoint& point : points_) {
    Verdict verdict;
    (void)fit->verdict_of(point.sequence, verdict);
    zones_.push_back(zone_of(verdict));
    if (c.use_approach) continue;
    const Vec3 approach = -(report.pose.rotation.transpose() * verdict.foot.normal);
    for (std::size_t k = 0; k < 3; ++k) point.approach[k] = approach[static_cast<Eigen::Index>(k)];
  }
}

DefectPatterns::Zone DefectPatterns::zone_of(const Verdict& verdict) const {
  if (verdict.region == Region::leading_edge) return Zone::leading_edge;
  const ReferenceCase::Box& box = case_.leading_edge.front();
  const double along = box.v[0] == 0.0 && box.v[1] == 1.0 ? verdict.foot.v : verdict.foot.u;
  return along < 0.07 || along > 0.93 ? Zone::span_end : Zone::anywhere;
}

std::vector<std::size_t> DefectPatterns::members(const std::vector<std::size_t>& kept, Zone zone) const {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (zone == Zone::anywhere || zones_[kept[i]] == zone) out.push_back(i);
  }
  return out;
}

DefectPattern DefectPatterns::make(std::uint64_t seed) const {
  std::mt19937_64 random(seed);
  DefectPattern pattern;
  constexpr std::size_t kStrides[] = {1, 1, 2, 5, 20};
  const std::size_t stride = kStrides[drawn_below(random, std::size(kStrides))];
  std::vector<std::size_t> kept;
  for (std::size_t i = drawn_below(random, stride); i < points_.size(); i += stride) kept.push_back(i);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    pattern.points.push_back(points_[kept[i]]);
    pattern.points.back().sequence = static_cast<std::uint32_t>(i + 1);
  }
  const std::vector<ProbePoint> good = pattern.points;
  pattern.text = std::to_string(good.size()) + " points:";
  const std::size_t spots = 1 + drawn_below(random, 6);
  constexpr Zone kZones[] = {Zone::leading_edge, Zone::leading_edge, Zone::span_end, Zone::anywhere};
  for (std::size_t s = 0; s < spots; ++s) {
    const std::vector<std::size_t> candidates = members(kept, kZones[drawn_below(random, std::size(kZones))]);
    const double size = std::exp(drawn(random, std::log(0.05), std::log(2.0)));
    const double height = drawn(random) < 0.5 ? size : -size;
    const std::size_t count = 1 + drawn_below(random, 10);
    if (candidates.empty()) continue;
    const std::size_t centre = candidates[drawn_below(random, candidates.size())];
    for (const std::size_t i : neighbours(good, centre, count)) {
      for (std::size_t k = 0; k < 3; ++k) pattern.points[i].position[k] -= height * pattern.points[i].approach[k];
    }
    pattern.text +=
        " " + std::to_string(count) + "x" + std::to_string(height).substr(0, 6) + "@" + std::to_string(centre);
  }
  pattern.leading_edge_mm = rms_mm_ * drawn(random, 1.5, 8.0);
  pattern.rest_mm = pattern.leading_edge_mm * (drawn(random) < 0.5 ? 10.0 : 3.0);
  return pattern;
}

}  // namespace bladefit::testing
