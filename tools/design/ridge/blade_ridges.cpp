#include "tools/design/ridge/blade_ridges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace bladefit {
namespace {

/// Sections that a patch is looked at with in either direction.
constexpr std::size_t kTrial = 9;
/// Outermost sections stand so far inside, where the line beyond an edge is not in doubt.
constexpr double kInset = 1e-6;
/// What bends by so much is an edge, and what goes on from an edge if it bends by so much [degrees].
constexpr double kEdge = 80, kGoesOn = 45;
/// A ridge does not move farther from one section to the next than this share of the section.
constexpr double kLargestStep = 0.15;

RidgedSection section_at(const PatchEdges& edges, IsoLine start, double constant, double least_degrees) {
  start.constant = std::clamp(constant, kInset, 1.0 - kInset);
  RidgedSection section;
  section.constant = constant;
  section.line = section_line(edges, start);
  const std::vector<SectionRidge> found = section_ridges(edges.surface(), section.line, least_degrees);
  for (std::size_t k = 0; k < found.size(); ++k) section.ridges[k] = found[k];
  return section;
}

double gap_between(const SectionRidge& a, const SectionRidge& b) { return (a.place.point - b.place.point).norm(); }

/// Puts the ridges of `section` into the order of those of `before`, a neighbour, and drops what is not near them.
void sort_like(const RidgedSection& before, RidgedSection& section) {
  std::optional<SectionRidge> found[2] = {section.ridges[0], section.ridges[1]};
  const double reach = kLargestStep * std::max(section.line.length(), before.line.length());
  section.ridges[0].reset();
  section.ridges[1].reset();
  const auto take = [&](std::size_t to) {
    if (!before.ridges[to]) return;
    std::optional<SectionRidge>* nearest = nullptr;
    for (std::optional<SectionRidge>& candidate : found) {
      if (!candidate || gap_between(*candidate, *before.ridges[to]) > reach) continue;
      const bool nearer = nearest == nullptr ||
                          gap_between(*candidate, *before.ridges[to]) < gap_between(**nearest, *before.ridges[to]);
      if (nearer) nearest = &candidate;
    }
    if (nearest == nullptr) return;
    section.ridges[to] = *nearest;
    nearest->reset();
  };
  take(0);
  take(1);
}

RidgedBlade blade_along(const PatchEdges& edges, const IsoLine& start, std::size_t count) {
  RidgedBlade blade{start, {}, 0};
  const std::size_t middle = count / 2;
  for (std::size_t k = 0; k < count; ++k) {
    const double constant = static_cast<double>(k) / static_cast<double>(count - 1);
    blade.sections.push_back(section_at(edges, start, constant, k == middle ? kEdge : kGoesOn));
  }
  for (std::size_t k = middle; k + 1 < count; ++k) sort_like(blade.sections[k], blade.sections[k + 1]);
  for (std::size_t k = middle; k > 0; --k) sort_like(blade.sections[k], blade.sections[k - 1]);
  const auto& ridges = blade.sections[middle].ridges;
  blade.count = (ridges[0] ? 1U : 0U) + (ridges[1] ? 1U : 0U);
  return blade;
}

double length_of_all(const RidgedBlade& blade) {
  double length = 0;
  for (std::size_t k = 0; k < blade.count; ++k) length += blade.length_of(k);
  return length;
}

}  // namespace

double RidgedBlade::length_of(std::size_t ridge) const {
  double length = 0;
  for (std::size_t k = 1; k < sections.size(); ++k) {
    const auto &a = sections[k - 1].ridges[ridge], &b = sections[k].ridges[ridge];
    if (a && b) length += gap_between(*a, *b);
  }
  return length;
}

const SectionRidge& RidgedBlade::middle_of(std::size_t ridge) const {
  return *sections[sections.size() / 2].ridges[ridge];
}

double RidgedBlade::distance_of(std::size_t ridge, const Vec3& place) const {
  double distance = std::numeric_limits<double>::infinity();
  for (const RidgedSection& section : sections) {
    if (section.ridges[ridge]) distance = std::min(distance, (section.ridges[ridge]->place.point - place).norm());
  }
  return distance;
}

std::vector<RidgedBlade> find_ridges(const Surface& surface, std::size_t sections) {
  const PatchEdges edges(surface);
  std::vector<RidgedBlade> blades;
  std::set<std::uint32_t> crossed;
  for (std::uint32_t patch = 0; patch < surface.image().patches().size(); ++patch) {
    if (crossed.contains(patch)) continue;
    RidgedBlade best = blade_along(edges, {patch, true, 0.5}, kTrial);
    const RidgedBlade other = blade_along(edges, {patch, false, 0.5}, kTrial);
    if (length_of_all(other) > length_of_all(best)) best = other;
    if (best.count == 0) continue;
    blades.push_back(blade_along(edges, best.start, sections));
    for (const SectionPoint& point : blades.back().sections[sections / 2].line.points) crossed.insert(point.patch);
  }
  std::erase_if(blades, [](const RidgedBlade& blade) { return blade.count == 0; });
  return blades;
}

}  // namespace bladefit
