#include "tools/design/image/span_reach.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bladefit {
namespace {

/// Of what samples show so much is tried.
constexpr double kShare = 0.7;
/// Where it does not hold it is lowered by this, until it is of no use [half diagonals].
constexpr double kLower = 0.75, kLeast = 1e-4;
/// Other feet are looked for so far off [half diagonals]: as far as streams ask, and twice.
constexpr double kApart = 0.01;
/// Leaves are cut so many times.
constexpr int kMostCuts = 10;
/// Two parts so small against their distance are not cut for it, nor, where only other feet are in question, two so
/// small.
constexpr double kSmallAgainst = 0.3, kSmallForFeet = 1.5;
/// Where one try meets so many pairs, which is where the surface bends sharply, it is given up for one of less.
constexpr int kMostPairs = 5000;
constexpr double kLessTried = 0.3, kLeastTried = 0.02;
/// Where the span does not go on smoothly in its patch, feet next to that are given up for the others [kInsetUnit].
constexpr std::uint8_t kInset = 24;
/// Parts of one worker.
constexpr std::size_t kMostLeavesKept = 4000;
/// What is handed on is less than what was proven by this share: rounding.
constexpr double kRounding = 1e-3;

using Sides = std::array<bool, 2>;
constexpr std::array<SurfaceSide, 2> kBoth{0, 1};

bool any(const Sides& sides) { return sides[0] || sides[1]; }

class SpanProof {
 public:
  /// Of the feet in a rectangle of the span.
  SpanProof(const ReachDesign& design, PartCache& parts, std::uint32_t span, const LocalRect& cell)
      : design_(design), surface_(design.surface), parts_(parts), span_(span), cell_(cell) {}

  SpanReach run() {
    if (!take_feet()) return {};
    make_guess();
    double tried = 1.0;
    while (!holds(tried) && tried > kLeastTried) tried *= kLessTried;
    SpanReach out;
    for (const SurfaceSide side : kBoth) out.reach[side] = (1.0 - kRounding) * reach_[side];
    out.apart = reach_[0] > 0.0 || reach_[1] > 0.0 ? (1.0 - kRounding) * apart_ : 0.0;
    return out;
  }

 private:
  /// This share of the guess, or what it has to be lowered to, was proven. Else the reach is nothing.
  bool holds(double tried) {
    pairs_ = 0;
    for (const SurfaceSide side : kBoth) reach_[side] = tried * guess_[side];
    apart_ = tried * kApart * surface_.half_diagonal();
    for (const std::unique_ptr<SurfacePart>& feet : feet_) {
      forms_.clear();
      compare_below(0, *feet, {true, true});
    }
    return pairs_ <= kMostPairs;
  }

  /// What of the leaves of the span lies in the rectangle; false where there is nothing.
  bool take_feet() {
    const auto leaves = surface_.image().leaves();
    auto leaf = std::lower_bound(leaves.begin(), leaves.end(), span_,
                                 [](const ImageLeaf& l, std::uint32_t span) { return l.span < span; });
    for (; leaf != leaves.end() && leaf->span == span_; ++leaf) {
      LocalRect rect = rect_of(*leaf);
      rect = {std::max(rect.s_min, cell_.s_min), std::min(rect.s_max, cell_.s_max), std::max(rect.t_min, cell_.t_min),
              std::min(rect.t_max, cell_.t_max)};
      if (rect.s_min < rect.s_max && rect.t_min < rect.t_max)
        feet_.push_back(std::make_unique<SurfacePart>(surface_, span_, rect, 0));
    }
    return !feet_.empty();
  }

  /// By the reach at some places of the span.
  void make_guess() {
    constexpr std::array<double, 3> kPlaces = {0.02, 0.5, 0.98};
    guess_.fill(design_.guess.most());
    const SpanDomain d = surface_.domain(span_);
    for (const double x : kPlaces) {
      for (const double y : kPlaces) {
        const double s = cell_.s_min + x * (cell_.s_max - cell_.s_min),
                     t = cell_.t_min + y * (cell_.t_max - cell_.t_min);
        const SurfacePoint at =
            surface_.evaluate({span_, d.u_min + s * (d.u_max - d.u_min), d.v_min + t * (d.v_max - d.v_min)});
        const Vec3 normal = at.s_u.cross(at.s_v).normalized();
        if (!normal.allFinite()) return;
        for (const SurfaceSide side : kBoth) {
          guess_[side] = std::min(guess_[side],
                                  kShare * design_.guess.radius_at(at.s, sign_of(side) * normal, design_.guess.most()));
        }
      }
    }
  }

  /// Holds the reach of a part against all that is below a node of the bounding tree.
  void compare_below(std::uint32_t node_index, SurfacePart& feet, Sides sides) {
    const ImageNode& node = surface_.image().nodes()[node_index];
    for (std::size_t k = 0; k < 4 && node.child[k] != kNoChild; ++k) {
      Sides open = still_open(sides);
      const PartView& view = feet.view();
      const FarBox box = view.regular ? far_box(view, node, k) : FarBox{};
      if (view.regular) settle_far(view, box, open);
      if (!any(open)) continue;
      const std::uint32_t index = node.child[k] & ~kLeafChild;
      if ((node.child[k] & kLeafChild) == 0) {
        compare_below(index, feet, open);
      } else if (index < surface_.image().leaves().size()) {
        compare(feet, parts_.of_leaf(index), open);
      } else {
        // Its points are those of leaves. But a loop holds local minima that a smooth piece about it does not.
        apart_ = std::min(apart_, box.distance());
      }
    }
  }

  /// Holds the reach of a part against another part, or the same.
  void compare(SurfacePart& feet, SurfacePart& other, Sides sides) {
    Sides open = still_open(sides);
    if (!any(open)) return;
    if (++pairs_ > kMostPairs) return reach_.fill(0.0);
    const PartView& view = feet.view();
    if (!view.regular) {
      if (feet.cuts() >= kMostCuts) return give_up(open);
      return compare_halves_of_feet(feet, other, open);
    }
    follow_curvature(view);
    const FarBox box = far_box(view, other);
    settle_far(view, box, open);
    if (!any(open)) return;
    std::optional<NearForm> form;
    if (feet.rect().patch == other.rect().patch) form = settle_near(view, hull_of(feet.rect(), other.rect()), open);
    if (!any(open)) return;
    const double sizes = feet.size() + other.size();
    const bool small =
        sizes < kSmallAgainst * box.distance() || (sizes < kSmallForFeet * box.distance() && clear_of(view, box, open));
    const bool feet_next = other.cuts() >= kMostCuts || (feet.cuts() < kMostCuts && feet.size() >= other.size());
    if (small || (feet.cuts() >= kMostCuts && other.cuts() >= kMostCuts)) return lower(view, box, form, open);
    if (feet_next) return compare_halves_of_feet(feet, other, open);
    for (SurfacePart* half : other.halves()) compare(feet, *half, open);
  }

  void compare_halves_of_feet(SurfacePart& feet, SurfacePart& other, const Sides& open) {
    for (SurfacePart* half : feet.halves()) {
      const std::size_t known = forms_.size();
      compare(*half, other, open);
      forms_.erase(forms_.begin() + static_cast<std::ptrdiff_t>(known), forms_.end());
    }
  }

  [[nodiscard]] Sides still_open(const Sides& sides) const {
    return {sides[0] && reach_[0] > 0.0, sides[1] && reach_[1] > 0.0};
  }

  void give_up(const Sides& open) {
    for (const SurfaceSide side : kBoth) {
      if (open[side]) reach_[side] = 0.0;
    }
  }

  /// No ball is greater than those of the curvature.
  void follow_curvature(const PartView& view) {
    for (const SurfaceSide side : kBoth) {
      if (view.curvature[side] * reach_[side] > kShare) set_reach(side, kShare / view.curvature[side]);
    }
  }

  void set_reach(SurfaceSide side, double reach) {
    reach_[side] = reach >= kLeast * surface_.half_diagonal() ? reach : 0.0;
  }

  [[nodiscard]] FarBox far_box(const PartView& feet, const SurfacePart& other) const {
    return {other.box_in(feet.frame) - feet.place};
  }

  [[nodiscard]] FarBox far_box(const PartView& feet, const ImageNode& node, std::size_t child) const {
    Vec3 middle, half;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = static_cast<double>(node.low[axis][child]), high = static_cast<double>(node.high[axis][child]);
      middle[static_cast<Eigen::Index>(axis)] = 0.5 * (low + high);
      half[static_cast<Eigen::Index>(axis)] = 0.5 * (high - low);
    }
    const Vec3 at = feet.frame.axes * (middle + surface_.middle() - feet.frame.middle);
    const Vec3 wide = feet.frame.axes.cwiseAbs() * half;
    const auto interval = [&](Eigen::Index k) { return Interval{at[k] - wide[k], at[k] + wide[k]}; };
    return {IntervalVector{interval(0), interval(1), interval(2)} - feet.place};
  }

  void settle_far(const PartView& view, const FarBox& box, Sides& open) const {
    if (box.distance() < apart_) return;
    for (const SurfaceSide side : kBoth) open[side] = open[side] && !box.clear(view, side, reach_[side]);
  }

  [[nodiscard]] bool clear_of(const PartView& view, const FarBox& box, const Sides& open) const {
    return (!open[0] || box.clear(view, 0, reach_[0])) && (!open[1] || box.clear(view, 1, reach_[1]));
  }

  /// By a form over a larger rectangle, or one over this: that comes back.
  std::optional<NearForm> settle_near(const PartView& view, const PatchRect& rect, Sides& open) {
    const auto settle = [&](const NearForm& form) {
      for (const SurfaceSide side : kBoth) open[side] = open[side] && !form.clear(side, reach_[side]);
    };
    for (const NearForm& form : forms_) {
      if (form.rect.holds(rect)) settle(form);
    }
    if (!any(open)) return std::nullopt;
    const std::optional<NearForm> form = near_form(surface_, design_.smooth, view, rect);
    if (!form) return form;
    settle(*form);
    forms_.push_back(*form);
    return form;
  }

  /// What is no longer cut: the reach falls until the balls are clear of it, or to nothing.
  void lower(const PartView& view, const FarBox& box, const std::optional<NearForm>& form, const Sides& open) {
    for (const SurfaceSide side : kBoth) {
      if (!open[side]) continue;
      const auto near = [&] { return form && form->clear(side, reach_[side]); };
      const auto far = [&] { return box.clear(view, side, reach_[side]); };
      while (reach_[side] > 0.0 && !near() && !far()) set_reach(side, kLower * reach_[side]);
      if (reach_[side] > 0.0 && !near()) apart_ = std::min(apart_, box.distance());
    }
  }

  const ReachDesign& design_;
  const Surface& surface_;
  PartCache& parts_;
  std::uint32_t span_;
  LocalRect cell_;
  std::vector<std::unique_ptr<SurfacePart>> feet_;
  std::array<double, 2> guess_{};  ///< what is tried first [mm]
  std::array<double, 2> reach_{};  ///< what nothing has refuted yet [mm]
  double apart_ = 0;               ///< the same
  int pairs_ = 0;
  std::vector<NearForm> forms_;  ///< of the feet in hand, and of what they were cut of
};

}  // namespace

SurfacePart& PartCache::of_leaf(std::uint32_t leaf) {
  std::unique_ptr<SurfacePart>& part = parts_[leaf];
  if (!part) {
    const ImageLeaf& l = surface_.image().leaves()[leaf];
    part = std::make_unique<SurfacePart>(surface_, l.span, rect_of(l), 0);
  }
  return *part;
}

void PartCache::trim() {
  if (parts_.size() > kMostLeavesKept) parts_.clear();
}

SpanReach prove_reach(const ReachDesign& design, PartCache& parts, std::uint32_t span) {
  parts.trim();
  const SpanReach whole = SpanProof(design, parts, span, {}).run();
  const std::uint32_t ends = design.smooth.rough_sides(span);
  if (whole.proves() || ends == 0) return whole;
  std::array<std::uint8_t, 4> inset{};
  for (std::size_t side = 0; side < inset.size(); ++side) inset[side] = (ends & (1U << side)) != 0 ? kInset : 0;
  const auto share = [&](std::size_t side) { return kInsetUnit * static_cast<double>(inset[side]); };
  const LocalRect cell{share(kLowU), 1.0 - share(kHighU), share(kLowV), 1.0 - share(kHighV)};
  SpanReach inner = SpanProof(design, parts, span, cell).run();
  if (inner.proves()) inner.inset = inset;
  return inner;
}

}  // namespace bladefit
