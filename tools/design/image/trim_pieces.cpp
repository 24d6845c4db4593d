#include "tools/design/image/trim_pieces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/surface/surface.hpp"
#include "core/geometry/surface/trim.hpp"
#include "tools/design/image/piece_bounds.hpp"
#include "tools/design/nurbs/trim_loops.hpp"

namespace bladefit {
namespace {

/// A piece leaves the straight line between its ends by no more than this share of its length, as far as so many cuts
/// can do that.
constexpr double kMostSag = 0.01;
constexpr int kMostSagCuts = 8;
/// Pieces in a slab, about.
constexpr std::size_t kTrimsInSlab = 4, kMostSlabs = 4096;
/// Boxes are wider than what they hold by this share of its coordinates.
constexpr double kRunMargin = 1e-12;

/// The interval that a parameter lies in.
std::size_t interval_of(const std::vector<double>& breaks, double t) {
  const auto above = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, t);
  return static_cast<std::size_t>(above - breaks.begin()) - 1;
}

/// What is so near to a break is on it: crossings are rounded.
double on_break(const std::vector<double>& breaks, double t) {
  constexpr double kSameBreak = 1e-13;
  const auto above = std::lower_bound(breaks.begin(), breaks.end(), t - kSameBreak);
  return above != breaks.end() && *above <= t + kSameBreak ? *above : t;
}

/// The span that a piece lies in: that of its middle.
struct PieceSpan {
  std::size_t iu, iv;
  double u_min, u_max, v_min, v_max;

  PieceSpan(const BezierPatch& patch, const TrimVertex& a, const TrimVertex& b)
      : iu(interval_of(patch.breaks_u, 0.5 * (a.u + b.u))),
        iv(interval_of(patch.breaks_v, 0.5 * (a.v + b.v))),
        u_min(patch.breaks_u[iu]),
        u_max(patch.breaks_u[iu + 1]),
        v_min(patch.breaks_v[iv]),
        v_max(patch.breaks_v[iv + 1]) {}

  [[nodiscard]] std::size_t index(const BezierPatch& patch) const { return iu * patch.spans_v() + iv; }
  /// The piece in the parameters of the span.
  [[nodiscard]] SpanLine line(const TrimVertex& a, const TrimVertex& b) const {
    const auto s = [&](double u) { return std::clamp((u - u_min) / (u_max - u_min), 0.0, 1.0); };
    const auto t = [&](double v) { return std::clamp((v - v_min) / (v_max - v_min), 0.0, 1.0); };
    return {s(a.u), t(a.v), s(b.u), t(b.v)};
  }
};

/// Where the way from `a` to `b` crosses lines between spans, with those coordinates to the bit.
void append_crossings(const BezierPatch& patch, const TrimVertex& a, const TrimVertex& b, TrimLoop& out) {
  std::vector<std::pair<double, TrimVertex>> crossings;
  const auto look = [&](const std::vector<double>& breaks, double from, double to, bool in_u) {
    for (std::size_t k = 1; k + 1 < breaks.size(); ++k) {
      const double line = breaks[k];
      if ((from < line) == (to < line) || from == line || to == line) continue;
      const double share = (line - from) / (to - from);
      TrimVertex place{a.u + share * (b.u - a.u), a.v + share * (b.v - a.v), false};
      place.u = on_break(patch.breaks_u, place.u);
      place.v = on_break(patch.breaks_v, place.v);
      (in_u ? place.u : place.v) = line;
      crossings.emplace_back(share, place);
    }
  };
  look(patch.breaks_u, a.u, b.u, true);
  look(patch.breaks_v, a.v, b.v, false);
  std::ranges::sort(crossings, {}, &std::pair<double, TrimVertex>::first);
  for (const auto& [share, place] : crossings) {
    if (place.u != out.back().u || place.v != out.back().v) out.push_back(place);
  }
}

/// The piece from the last vertex of `out` to `b`, without `b`, cut until each part is nearly straight.
void append_parts(const BezierPatch& patch, const TrimVertex& b, int cuts, TrimLoop& out) {
  const TrimVertex a = out.back();
  const PieceSpan span(patch, a, b);
  const PieceBounds bounds = piece_bounds(patch.span(span.index(patch)), span.line(a, b));
  const double length = (bounds.end - bounds.start).norm();
  if (cuts == kMostSagCuts || bounds.bend <= 8.0 * kMostSag * length) return;
  const TrimVertex middle{0.5 * (a.u + b.u), 0.5 * (a.v + b.v), false};
  if ((middle.u == a.u && middle.v == a.v) || (middle.u == b.u && middle.v == b.v)) return;
  append_parts(patch, middle, cuts + 1, out);
  out.push_back(middle);
  append_parts(patch, b, cuts + 1, out);
}

bool same_place(const TrimVertex& a, const TrimVertex& b) { return a.u == b.u && a.v == b.v; }

/// Pieces of no length are none.
TrimLoop without_repeats(const TrimLoop& loop) {
  TrimLoop out;
  for (const TrimVertex& vertex : loop) {
    if (!out.empty() && same_place(out.back(), vertex)) {
      out.back().corner = out.back().corner || vertex.corner;
    } else {
      out.push_back(vertex);
    }
  }
  while (out.size() > 1 && same_place(out.front(), out.back())) {
    out.front().corner = out.front().corner || out.back().corner;
    out.pop_back();
  }
  return out;
}

void append_piece(const BezierPatch& patch, std::uint32_t first_span, const TrimVertex& a, const TrimVertex& b,
                  TrimParts& parts) {
  const PieceSpan span(patch, a, b);
  const PieceBounds bounds = piece_bounds(patch.span(span.index(patch)), span.line(a, b));
  ImageTrim piece{};
  piece.u = a.u;
  piece.v = a.v;
  std::copy(bounds.start.begin(), bounds.start.end(), piece.start);
  piece.slope = bounds.slope;
  piece.bend = bounds.bend;
  piece.third = bounds.third;
  piece.span = first_span + static_cast<std::uint32_t>(span.index(patch));
  piece.corner = a.corner ? 1 : 0;
  parts.pieces.push_back(piece);
}

/// Runs of the pieces from `first` on, which are one loop.
void append_runs(std::size_t first, TrimParts& parts) {
  const std::size_t end = parts.pieces.size();
  for (std::size_t from = first; from < end; from += kMostTrimsInRun) {
    const std::size_t count = std::min<std::size_t>(kMostTrimsInRun, end - from);
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (std::size_t k = from; k < from + count; ++k) {
        const double margin = 0.125 * parts.pieces[k].bend;
        for (const ImageTrim* place : {&parts.pieces[k], &parts.pieces[parts.pieces[k].next]}) {
          low = std::min(low, place->start[axis] - margin);
          high = std::max(high, place->start[axis] + margin);
        }
      }
      const double margin = kRunMargin * std::max(std::abs(low), std::abs(high));
      box.min[axis] = low - margin;
      box.max[axis] = high + margin;
    }
    parts.runs.push_back({static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(count), 0, 0});
    parts.boxes.push_back(box);
  }
}

/// Slabs of a patch whose pieces begin at `first`.
void append_slabs(std::size_t first, TrimParts& parts) {
  const std::size_t pieces = parts.pieces.size() - first;
  const auto count = static_cast<std::uint32_t>(std::clamp<std::size_t>(pieces / kTrimsInSlab, 1, kMostSlabs));
  std::vector<std::vector<std::uint32_t>> held(count);
  for (std::size_t k = first; k < parts.pieces.size(); ++k) {
    const double from = parts.pieces[k].v, to = parts.pieces[parts.pieces[k].next].v;
    for (std::uint32_t slab = slab_of(std::min(from, to), count); slab <= slab_of(std::max(from, to), count); ++slab) {
      held[slab].push_back(static_cast<std::uint32_t>(k));
    }
  }
  for (const std::vector<std::uint32_t>& trims : held) {
    parts.slabs.push_back(
        {static_cast<std::uint32_t>(parts.slab_trims.size()), static_cast<std::uint32_t>(trims.size())});
    parts.slab_trims.insert(parts.slab_trims.end(), trims.begin(), trims.end());
  }
}

}  // namespace

std::vector<TrimLoop> pieces_of(const std::vector<TrimLoop>& loops, const BezierPatch& patch) {
  std::vector<TrimLoop> result;
  for (TrimLoop loop : loops) {
    for (TrimVertex& vertex : loop) {
      vertex.u = on_break(patch.breaks_u, vertex.u);
      vertex.v = on_break(patch.breaks_v, vertex.v);
    }
    TrimLoop cut;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      cut.push_back(loop[k]);
      append_crossings(patch, loop[k], loop[(k + 1) % loop.size()], cut);
    }
    cut = without_repeats(cut);
    if (cut.size() < 2) continue;
    TrimLoop& fine = result.emplace_back();
    for (std::size_t k = 0; k < cut.size(); ++k) {
      fine.push_back(cut[k]);
      append_parts(patch, cut[(k + 1) % cut.size()], 0, fine);
    }
  }
  return result;
}

void append_trims(const std::vector<TrimLoop>& loops, const BezierPatch& patch, std::uint32_t first_span,
                  TrimParts& parts) {
  const std::size_t first = parts.pieces.size();
  for (const TrimLoop& loop : loops) {
    const std::size_t from = parts.pieces.size();
    each_piece({loop}, [&](const TrimVertex& a, const TrimVertex& b) { append_piece(patch, first_span, a, b, parts); });
    for (std::size_t k = 0; k < loop.size(); ++k) {
      parts.pieces[from + k].next = static_cast<std::uint32_t>(from + (k + 1) % loop.size());
      parts.pieces[from + k].previous = static_cast<std::uint32_t>(from + (k + loop.size() - 1) % loop.size());
    }
    append_runs(from, parts);
  }
  if (parts.pieces.size() > first) append_slabs(first, parts);
}

TrimmedSpan::TrimmedSpan(const std::vector<TrimLoop>& loops, const BezierPatch& patch, std::size_t iu, std::size_t iv)
    : loops_(loops),
      u_min_(patch.breaks_u[iu]),
      u_max_(patch.breaks_u[iu + 1]),
      v_min_(patch.breaks_v[iv]),
      v_max_(patch.breaks_v[iv + 1]) {}

bool TrimmedSpan::reaches(const LocalRect& rect) const {
  if (loops_.empty()) return true;
  const auto u = [&](double s) { return u_min_ + s * (u_max_ - u_min_); };
  const auto v = [&](double t) { return v_min_ + t * (v_max_ - v_min_); };
  const Eigen::AlignedBox2d box(Eigen::Vector2d(u(rect.s_min), v(rect.t_min)),
                                Eigen::Vector2d(u(rect.s_max), v(rect.t_max)));
  bool crossed = false;
  each_piece(loops_, [&](const TrimVertex& a, const TrimVertex& b) {
    Eigen::AlignedBox2d piece(Eigen::Vector2d(a.u, a.v));
    piece.extend(Eigen::Vector2d(b.u, b.v));
    if (crossed || !box.intersects(piece)) return;
    // All corners on one side of the piece: it passes by.
    int left = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const Eigen::Vector2d p = box.corner(static_cast<Eigen::AlignedBox2d::CornerType>(corner));
      left += (b.u - a.u) * (p.y() - a.v) - (b.v - a.v) * (p.x() - a.u) > 0.0 ? 1 : 0;
    }
    crossed = left != 0 && left != 4;
  });
  return crossed || inside_loops(loops_, box.center().x(), box.center().y());
}

}  // namespace bladefit
