#include "core/geometry/nearest/trim_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/surface/trim.hpp"

namespace bladefit {
namespace {

/// Parts of a piece are not shorter than 2^-kMostTrimCuts of it.
constexpr int kMostTrimCuts = 40;
/// Parts of one piece: one about whose centre of curvature the point lies must not use up the others' share.
constexpr std::uint32_t kMaxTrimParts = 256;
constexpr int kMaxTrimSteps = 40;
/// A slope of less than this counts as none [half diagonals].
constexpr double kLevel = 1e-10;

/// Half the squared distance along a piece: the place and two derivatives.
struct SlopeHere {
  SurfacePoint at;
  Vec3 offset;
  double along = 0;  ///< length of the tangent [mm]
  double first = 0, second = 0;
};

class TrimSearch {
 public:
  TrimSearch(const Surface& surface, const Vec3& r, NearestSoFar& nearest)
      : surface_(surface),
        image_(surface.image()),
        r_(r),
        nearest_(nearest),
        level_(kLevel * surface.half_diagonal()) {}

  LeafOutcome run(const ImageTrimRun& run, std::uint32_t budget) {
    for (std::uint32_t k = run.first; k < run.first + run.count; ++k) {
      const ImageTrim& trim = image_.trims()[k];
      if (least_to(trim) >= nearest_.limit()) continue;
      enter(k);
      look_at_start();
      // A piece along a collapsed side is a point.
      if (trim.slope > level_) look_along(std::min(budget - outcome_.pieces, kMaxTrimParts));
    }
    return outcome_;
  }

 private:
  /// No place of the piece is nearer than this [mm].
  [[nodiscard]] double least_to(const ImageTrim& trim) const {
    const Vec3 from(trim.start), to(image_.trims()[trim.next].start), way = to - from, arm = r_ - from;
    const double square = way.squaredNorm();
    const double t = square > 0.0 ? std::clamp(arm.dot(way) / square, 0.0, 1.0) : 0.0;
    return (arm - t * way).norm() - 0.125 * trim.bend;
  }

  void enter(std::uint32_t k) {
    index_ = k;
    trim_ = &image_.trims()[k];
    line_ = line_of(image_, k);
    domain_ = surface_.domain(line_.span);
  }

  [[nodiscard]] SurfacePlace place_at(double t) const {
    SurfacePlace place = line_.at(t);
    place.u = std::clamp(place.u, domain_.u_min, domain_.u_max);
    place.v = std::clamp(place.v, domain_.v_min, domain_.v_max);
    return place;
  }

  [[nodiscard]] SlopeHere slope_at(double t) const {
    SlopeHere here;
    here.at = surface_.evaluate(place_at(t));
    here.offset = r_ - here.at.s;
    const Vec3 tangent = tangent_along(here.at, line_.du, line_.dv);
    here.along = tangent.norm();
    here.first = -here.offset.dot(tangent);
    here.second = tangent.squaredNorm() - here.offset.dot(second_along(here.at, line_.du, line_.dv));
    return here;
  }

  /// The face has an angle of at most 180 degrees at the start of the piece, which only then can be nearest.
  [[nodiscard]] bool convex_at(const TrimLine& before, const TrimLine& after) const {
    return before.du * after.dv - before.dv * after.du >= 0.0;
  }

  /// The distance does not fall along this way of the parameters.
  [[nodiscard]] bool rises(const SurfacePoint& at, const Vec3& offset, double du, double dv) const {
    const Vec3 way = tangent_along(at, du, dv);
    return offset.dot(way) <= level_ * way.norm();
  }

  void look_at_start() {
    if ((r_ - Vec3(trim_->start)).norm() >= nearest_.limit()) return;
    const TrimLine before = line_of(image_, trim_->previous);
    if (!convex_at(before, line_)) return;
    const SlopeHere here = slope_at(0.0);
    if (!rises(here.at, here.offset, line_.du, line_.dv)) return;
    const SurfacePoint other = before.span == line_.span ? here.at : surface_.evaluate({before.span, line_.u, line_.v});
    if (!rises(other, here.offset, -before.du, -before.dv)) return;
    // Half way between the two, which a straight loop needs.
    const double size_before = std::sqrt(before.du * before.du + before.dv * before.dv);
    const double size = std::sqrt(line_.du * line_.du + line_.dv * line_.dv);
    if (!(size_before > 0.0 && size > 0.0)) return;
    const double du = before.du / size_before + line_.du / size, dv = before.dv / size_before + line_.dv / size;
    if (rises(here.at, here.offset, -dv, du)) show(0.0, here, trim_->corner != 0);
  }

  void look_along(std::uint32_t budget) {
    struct Part {
      double from, to;
      int cuts;
    };
    std::array<Part, kMostTrimCuts + 2> stack;
    std::size_t size = 0;
    stack[size++] = {0.0, 1.0, 0};
    for (std::uint32_t parts = 0; size > 0; ++parts) {
      const Part part = stack[--size];
      if (parts == budget || part.cuts >= kMostTrimCuts) {
        outcome_.exhausted = true;
        return;
      }
      if (settled(part.from, part.to)) continue;
      ++outcome_.pieces;
      const double middle = 0.5 * (part.from + part.to);
      stack[size++] = {part.from, middle, part.cuts + 1};
      stack[size++] = {middle, part.to, part.cuts + 1};
    }
  }

  /// The part is farther than what matters, has no minimum inside, or its only one was shown.
  bool settled(double from, double to) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    const SlopeHere here = slope_at(middle);
    const double distance = here.offset.norm(), way = trim_->slope * half;
    if (distance - way >= nearest_.limit()) return true;
    const double turn = half * (3.0 * trim_->slope * trim_->bend + (distance + way) * trim_->third);
    if (std::abs(here.first) > half * (std::abs(here.second) + turn) + level_ * here.along) return true;
    if (here.second + turn < 0.0) return true;
    if (!(here.second - turn > 0.0)) return false;
    find_minimum(from, to, middle, here);
    return true;
  }

  /// Newton's method with halving, of a convex function.
  void find_minimum(double from, double to, double t, SlopeHere here) {
    double low = from, high = to;
    for (int k = 0; k < kMaxTrimSteps && std::abs(here.first) > 1e-3 * level_ * here.along; ++k) {
      (here.first > 0.0 ? high : low) = t;
      double next = t - here.first / here.second;
      if (!(next > low && next < high))
        next = next <= from || next >= to ? std::clamp(next, from, to) : 0.5 * (low + high);
      if (next == t) break;
      t = next;
      here = slope_at(t);
    }
    if (std::abs(here.first) > level_ * here.along) return;  // it falls beyond an end of the part
    // A corner is looked at as the start of a piece.
    if (t <= 0.0 && convex_at(line_of(image_, trim_->previous), line_)) return;
    if (t >= 1.0 && convex_at(line_, line_of(image_, trim_->next))) return;
    if (rises(here.at, here.offset, -line_.dv, line_.du)) show(t, here, false);
  }

  void show(double t, const SlopeHere& here, bool corner) {
    Projection found;
    found.place = place_at(t);
    found.at = here.at;
    found.offset = here.offset;
    found.converged = true;
    found.trim = {index_, corner, line_.du, line_.dv};
    nearest_.consider(found);
  }

  const Surface& surface_;
  const DesignImage& image_;
  const Vec3& r_;
  NearestSoFar& nearest_;
  double level_;
  LeafOutcome outcome_;
  std::uint32_t index_ = 0;  ///< of the piece in hand
  const ImageTrim* trim_ = nullptr;
  TrimLine line_;
  SpanDomain domain_{};
};

}  // namespace

LeafOutcome search_run(const Surface& surface, const Vec3& r, std::uint32_t run, std::uint32_t budget,
                       NearestSoFar& nearest) {
  return TrimSearch(surface, r, nearest).run(surface.image().runs()[run], budget);
}

}  // namespace bladefit
