#include "tools/design/ridge/section_ridges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace bladefit {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kBend = 45.0 * kDegree;            ///< by which the normal turns in the part whose middle is the ridge
constexpr double kReach = 0.1, kApart = 1.0 / 6.0;  ///< shares of the section

/// The turning of a section as a function of its arc; of a closed one over two rounds, so that no part of it is cut.
class Turning {
 public:
  explicit Turning(const SectionLine& section) : length_(section.length()), closed_(section.closed) {
    const double whole = section.points.back().turn;
    for (const double round : {0.0, 1.0}) {
      if (round > 0.0 && !closed_) break;
      for (const SectionPoint& point : section.points) {
        arcs_.push_back(point.arc + round * length_);
        turns_.push_back(point.turn + round * whole);
      }
    }
  }

  /// The arc at which the normal has turned by `turn`, and the other way round.
  [[nodiscard]] double arc_of(double turn) const { return interpolated(turns_, arcs_, turn); }
  [[nodiscard]] double turn_of(double arc) const { return interpolated(arcs_, turns_, arc); }

  /// How much it turns within a length about an arc.
  [[nodiscard]] double within(double arc, double reach) const {
    const double middle = closed_ && arc < 0.5 * length_ ? arc + length_ : arc;
    return turn_of(middle + 0.5 * reach) - turn_of(middle - 0.5 * reach);
  }

  /// How far two places are apart on the section.
  [[nodiscard]] double apart(double a, double b) const {
    const double direct = std::abs(a - b);
    return closed_ ? std::min(direct, length_ - direct) : direct;
  }

  /// The middle of the shortest part that turns by kBend, where `allowed`; with the length of that part. Nothing where
  /// the section turns by less.
  template <class Allowed>
  [[nodiscard]] std::optional<std::pair<double, double>> shortest(Allowed allowed) const {
    std::optional<std::pair<double, double>> best;
    for (std::size_t k = 0; k < arcs_.size() && turns_[k] + kBend <= turns_.back(); ++k) {
      const double part = arc_of(turns_[k] + kBend) - arcs_[k];
      if (best && part >= best->second) continue;
      double middle = arc_of(turns_[k] + 0.5 * kBend);
      if (closed_ && middle >= length_) middle -= length_;
      if (!allowed(middle)) continue;
      best = {middle, part};
    }
    return best;
  }

  [[nodiscard]] double length() const { return length_; }

 private:
  static double interpolated(const std::vector<double>& from, const std::vector<double>& to, double value) {
    const auto after = std::ranges::upper_bound(from, value);
    if (after == from.begin()) return to.front();
    if (after == from.end()) return to.back();
    const auto k = static_cast<std::size_t>(after - from.begin());
    return to[k - 1] + (value - from[k - 1]) / (from[k] - from[k - 1]) * (to[k] - to[k - 1]);
  }

  double length_;
  bool closed_;
  std::vector<double> arcs_, turns_;
};

}  // namespace

std::vector<SectionRidge> section_ridges(const Surface& surface, const SectionLine& section, double least_degrees) {
  std::vector<SectionRidge> ridges;
  if (!(section.length() > 0.0)) return ridges;
  const Turning turning(section);
  std::optional<double> taken;
  for (int k = 0; k < 2; ++k) {
    const auto found =
        turning.shortest([&](double arc) { return !taken || turning.apart(arc, *taken) >= kApart * turning.length(); });
    if (!found || turning.within(found->first, kReach * turning.length()) < least_degrees * kDegree) break;
    ridges.push_back({place_on(surface, section, found->first), found->second / kBend});
    taken = found->first;
  }
  return ridges;
}

std::optional<SectionRidge> ridge_going_on(const Surface& surface, const SectionLine& section, double share,
                                           double reach, double least_degrees) {
  if (!(section.length() > 0.0)) return std::nullopt;
  const Turning turning(section);
  const double length = turning.length();
  const auto found = turning.shortest([&](double arc) { return turning.apart(arc, share * length) <= reach * length; });
  if (!found || turning.within(found->first, kReach * length) < least_degrees * kDegree) return std::nullopt;
  return SectionRidge{place_on(surface, section, found->first), found->second / kBend};
}

SectionSides sides_of(const SectionLine& section, const SectionRidge& ridge, const SectionRidge* other) {
  const double length = section.length(), arc = ridge.place.arc;
  SectionSides sides{length - arc, arc};
  if (section.closed) sides = {0.5 * length, 0.5 * length};
  if (other == nullptr) return sides;
  const double ahead = other->place.arc - arc;
  if (section.closed) return {ahead > 0.0 ? ahead : ahead + length, ahead > 0.0 ? length - ahead : -ahead};
  (ahead > 0.0 ? sides.after : sides.before) = std::abs(ahead);
  return sides;
}

double chord_of(const SectionLine& section, const SectionRidge& ridge, const SectionRidge* other) {
  if (other != nullptr) return (other->place.point - ridge.place.point).norm();
  double farthest = 0;
  for (const SectionPoint& point : section.points) {
    farthest = std::max(farthest, (point.point - ridge.place.point).norm());
  }
  return farthest;
}

}  // namespace bladefit
