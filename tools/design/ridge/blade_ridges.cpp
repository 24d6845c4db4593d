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
/// In shares of a section, a ridge is no farther from where it was on the section before than kStay, and kMove for the
/// whole blade: it follows one bend where a blunt nose has several.
constexpr double kStay = 0.001, kMove = 0.2;

double gap_between(const SectionRidge& a, const SectionRidge& b) { return (a.place.point - b.place.point).norm(); }

RidgedSection section_at(const PatchEdges& edges, IsoLine start, double constant) {
  start.constant = std::clamp(constant, kInset, 1.0 - kInset);
  RidgedSection section;
  section.constant = constant;
  section.line = section_line(edges, start);
  return section;
}

/// The ridges of `section` that go on from those of `before`, a neighbour.
void follow_ridges(const Surface& surface, const RidgedSection& before, double reach, RidgedSection& section) {
  for (std::size_t k = 0; k < 2; ++k) {
    if (!before.ridges[k]) continue;
    const double share = before.ridges[k]->place.arc / before.line.length();
    section.ridges[k] = ridge_going_on(surface, section.line, share, reach, kGoesOn);
  }
}

RidgedBlade blade_along(const PatchEdges& edges, const IsoLine& start, std::size_t count) {
  RidgedBlade blade{start, {}, 0};
  for (std::size_t k = 0; k < count; ++k)
    blade.sections.push_back(section_at(edges, start, static_cast<double>(k) / static_cast<double>(count - 1)));
  const std::size_t middle = count / 2;
  const std::vector<SectionRidge> found = section_ridges(edges.surface(), blade.sections[middle].line, kEdge);
  blade.count = found.size();
  for (std::size_t k = 0; k < found.size(); ++k) blade.sections[middle].ridges[k] = found[k];
  const double reach = kStay + kMove / static_cast<double>(count - 1);
  for (std::size_t k = middle; k + 1 < count; ++k)
    follow_ridges(edges.surface(), blade.sections[k], reach, blade.sections[k + 1]);
  for (std::size_t k = middle; k > 0; --k)
    follow_ridges(edges.surface(), blade.sections[k], reach, blade.sections[k - 1]);
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
