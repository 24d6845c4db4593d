#include "tools/drawing/radius_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/geometry/surface/trim.hpp"

namespace bladefit {
namespace {

constexpr double kNodes = 100000;
constexpr std::size_t kFewestCells = 8, kMostCells = 256;
constexpr int kSecants = 4;

std::size_t cells_for(std::size_t pieces) {
  const double cells = std::sqrt(kNodes / static_cast<double>(std::max<std::size_t>(pieces, 1)));
  return std::clamp(static_cast<std::size_t>(cells), kFewestCells, kMostCells);
}

bool holds(const ParameterBox& box, double u, double v) {
  return box.u_min <= u && u <= box.u_max && box.v_min <= v && v <= box.v_max;
}

}  // namespace

RadiusGrid::RadiusGrid(const Surface& surface, const ShaftFrame& frame, const std::vector<ParameterBox>& boxes)
    : surface_(surface), frame_(frame), least_(std::numeric_limits<double>::infinity()) {
  const std::size_t count = surface.image().patches().size();
  for (std::uint32_t patch = 0; patch < count; ++patch) {
    std::vector<ParameterBox> holes;
    std::ranges::copy_if(boxes, std::back_inserter(holes),
                         [patch](const ParameterBox& box) { return box.patch == patch; });
    add({.patch = patch}, cells_for(count), false, std::move(holes));
  }
  for (const ParameterBox& box : boxes) add(box, cells_for(boxes.size()), true, {});
}

void RadiusGrid::add(const ParameterBox& box, std::size_t steps, bool leading_edge, std::vector<ParameterBox> holes) {
  if (box.patch >= surface_.image().patches().size()) return;
  Patch patch{box, steps, leading_edge, {}, std::move(holes)};
  patch.radius.reserve((steps + 1) * (steps + 1));
  for (std::size_t i = 0; i <= steps; ++i) {
    for (std::size_t j = 0; j <= steps; ++j) {
      const SurfacePlace place =
          surface_.place_at(box.patch, patch.u(static_cast<double>(i)), patch.v(static_cast<double>(j)));
      double radius = std::numeric_limits<double>::quiet_NaN();
      if (inside_face(surface_.image(), place)) {
        radius = frame_.radius_of(surface_.evaluate(place).s);
        least_ = std::min(least_, radius);
        greatest_ = std::max(greatest_, radius);
      }
      patch.radius.push_back(radius);
    }
  }
  patches_.push_back(std::move(patch));
}

/// By the secant method between the two nodes, kept between them.
UnrolledPlace RadiusGrid::crossing(const Patch& patch, const Edge& edge, double radius) const {
  const auto place_of = [&](double t) {
    const double i = static_cast<double>(edge.i) + t * (static_cast<double>(edge.i2) - static_cast<double>(edge.i));
    const double j = static_cast<double>(edge.j) + t * (static_cast<double>(edge.j2) - static_cast<double>(edge.j));
    return surface_.evaluate(surface_.place_at(patch.box.patch, patch.u(i), patch.v(j))).s;
  };
  double low = 0, high = 1, at_low = patch.at(edge.i, edge.j) - radius, at_high = patch.at(edge.i2, edge.j2) - radius;
  Vec3 place = place_of(0);
  for (int k = 0; k < kSecants; ++k) {
    const double t = low + (high - low) * at_low / (at_low - at_high);
    place = place_of(t);
    const double at = frame_.radius_of(place) - radius;
    if (at == 0.0) break;
    const bool below = (at < 0) == (at_low < 0);
    (below ? low : high) = t;
    (below ? at_low : at_high) = at;
  }
  return frame_.unrolled(place, radius);
}

void RadiusGrid::cut_cell(const Patch& patch, std::size_t i, std::size_t j, double radius,
                          std::vector<SectionPiece>& out) const {
  const std::array<Edge, 4> edges = {
      {{i, j, i + 1, j}, {i + 1, j, i + 1, j + 1}, {i + 1, j + 1, i, j + 1}, {i, j + 1, i, j}}};
  std::array<UnrolledPlace, 4> found;
  std::size_t count = 0;
  for (const Edge& edge : edges) {
    const double a = patch.at(edge.i, edge.j), b = patch.at(edge.i2, edge.j2);
    if (std::isnan(a) || std::isnan(b)) return;
    if ((a < radius) != (b < radius)) found.at(count++) = crossing(patch, edge, radius);
  }
  for (std::size_t k = 0; k + 1 < count; k += 2) out.push_back({found.at(k), found.at(k + 1), patch.leading_edge});
}

std::vector<SectionPiece> RadiusGrid::cut(double radius) const {
  std::vector<SectionPiece> pieces;
  for (const Patch& patch : patches_) {
    for (std::size_t i = 0; i < patch.steps; ++i) {
      const double u = patch.u(static_cast<double>(i) + 0.5);
      for (std::size_t j = 0; j < patch.steps; ++j) {
        const double a = patch.at(i, j), b = patch.at(i + 1, j), c = patch.at(i, j + 1), d = patch.at(i + 1, j + 1);
        const bool below = a < radius || b < radius || c < radius || d < radius;
        const bool above = a >= radius || b >= radius || c >= radius || d >= radius;
        if (!below || !above) continue;
        const double v = patch.v(static_cast<double>(j) + 0.5);
        if (std::ranges::any_of(patch.holes, [&](const ParameterBox& hole) { return holds(hole, u, v); })) continue;
        cut_cell(patch, i, j, radius, pieces);
      }
    }
  }
  return pieces;
}

}  // namespace bladefit
