#include "tools/design/ridge/section_line.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/geometry/surface/joint.hpp"

namespace bladefit {
namespace {

/// Steps along one patch to begin with; a step over which the normal turns by more than kTurn is halved, up to so
/// often.
constexpr int kSteps = 32, kHalvings = 14;
constexpr double kTurn = 0.02;  // [rad]
/// Patches that a section may cross.
constexpr std::size_t kMostPieces = 64;
/// How far in the constant parameter a closed section may miss its own beginning.
constexpr double kMiss = 0.05;

/// The part of a section on one patch.
struct SectionPiece {
  IsoLine line;
  bool rising = true;  ///< in the order of the section its parameter rises
};

SectionPoint point_at(const Surface& surface, const IsoLine& line, double t) {
  const double u = line.along_u ? t : line.constant, v = line.along_u ? line.constant : t;
  const SurfacePlace place = surface.place_at(line.patch, u, v);
  const SurfacePoint point = surface.evaluate(place);
  return {line.patch, u, v, point.s, surface.normal(place, point), 0, 0};
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// The end of a piece in the order of the section, or its beginning.
EdgePlace end_of(const SectionPiece& piece, bool last) {
  const bool high = piece.rising == last;
  const std::size_t edge = piece.line.along_u ? (high ? kHighU : kLowU) : (high ? kHighV : kLowV);
  return {piece.line.patch, edge, piece.line.constant};
}

/// The piece that begins, or with `backwards` ends, at an edge.
SectionPiece piece_from(const EdgePlace& place, bool backwards) {
  const bool low = place.edge == kLowU || place.edge == kLowV;
  return {{place.patch, place.edge == kLowU || place.edge == kHighU, place.t}, low != backwards};
}

/// The pieces that follow `first`, or with `backwards` stand before it. True: the last one leads back to `first`.
bool follow(const PatchEdges& edges, const SectionPiece& first, bool backwards, std::vector<SectionPiece>& pieces) {
  SectionPiece present = first;
  while (pieces.size() < kMostPieces) {
    const std::optional<EdgePlace> next = edges.beyond(end_of(present, !backwards));
    if (!next) return false;
    present = piece_from(*next, backwards);
    const bool first_patch = present.line.patch == first.line.patch && present.line.along_u == first.line.along_u;
    if (first_patch && std::abs(present.line.constant - first.line.constant) < kMiss) return true;
    pieces.push_back(present);
  }
  return false;
}

/// Appends the points of a piece after its first one, halving steps that turn too much.
void append_piece(const Surface& surface, const SectionPiece& piece, std::vector<SectionPoint>& points) {
  const double step = 1.0 / kSteps;
  const auto at = [&](double t) { return point_at(surface, piece.line, piece.rising ? t : 1.0 - t); };
  SectionPoint before = at(0.0);
  points.push_back(before);
  for (int k = 0; k < kSteps; ++k) {
    const double end = k + 1 == kSteps ? 1.0 : (k + 1) * step;
    double t = k * step, width = end - t;
    while (t < end) {
      const double to = std::min(end, t + width);
      const SectionPoint next = at(to);
      if (angle_between(before.normal, next.normal) > kTurn && width > std::ldexp(step, -kHalvings)) {
        width *= 0.5;
        continue;
      }
      points.push_back(next);
      before = next;
      t = to;
      width = std::min(2.0 * width, end - t);
    }
  }
}

void measure(SectionLine& section) {
  for (std::size_t k = 1; k < section.points.size(); ++k) {
    const SectionPoint& before = section.points[k - 1];
    SectionPoint& point = section.points[k];
    point.arc = before.arc + (point.point - before.point).norm();
    point.turn = before.turn + angle_between(before.normal, point.normal);
  }
}

}  // namespace

SectionLine section_line(const PatchEdges& edges, const IsoLine& start) {
  SectionLine section;
  const SectionPiece first{start, true};
  std::vector<SectionPiece> after, before;
  section.closed = follow(edges, first, false, after);
  if (!section.closed) follow(edges, first, true, before);
  std::vector<SectionPiece> pieces(before.rbegin(), before.rend());
  pieces.push_back(first);
  pieces.insert(pieces.end(), after.begin(), after.end());
  for (const SectionPiece& piece : pieces) append_piece(edges.surface(), piece, section.points);
  if (section.closed) section.points.push_back(section.points.front());
  measure(section);
  return section;
}

SectionPoint place_on(const Surface& surface, const SectionLine& section, double arc) {
  const double length = section.length();
  if (section.closed && length > 0.0) arc -= std::floor(arc / length) * length;
  arc = std::clamp(arc, 0.0, length);
  const auto after = std::ranges::upper_bound(section.points, arc, {}, &SectionPoint::arc);
  if (after == section.points.begin()) return section.points.front();
  if (after == section.points.end()) return section.points.back();
  const SectionPoint &a = *(after - 1), &b = *after;
  if (a.patch != b.patch) return a;  // across a joint
  const bool along_u = a.v == b.v;
  const IsoLine line{a.patch, along_u, along_u ? a.v : a.u};
  const double from = along_u ? a.u : a.v, to = along_u ? b.u : b.v;
  const double wanted = arc - a.arc, chord = b.arc - a.arc;
  double share = wanted / chord;
  SectionPoint found = a;
  for (int k = 0; k < 4; ++k) {
    found = point_at(surface, line, from + share * (to - from));
    const double reached = (found.point - a.point).norm();
    if (!(reached > 0.0)) break;
    share = std::clamp(share * wanted / reached, 0.0, 1.0);
  }
  found.arc = arc;
  found.turn = a.turn + share * (b.turn - a.turn);
  return found;
}

}  // namespace bladefit
