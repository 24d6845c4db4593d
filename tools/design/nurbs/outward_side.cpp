#include "tools/design/nurbs/outward_side.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/surface/trim.hpp"
#include "tools/design/nurbs/facets.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// Pairs of facets of a whole design that is looked at coarsely, and parts of each direction of a patch there at least.
constexpr double kCoarseFacets = 600;
constexpr std::size_t kLeastCounted = 4;
/// Points from which the winding number is taken.
constexpr std::size_t kSamples = 160;
/// From where on a winding number counts as "enclosed". An open sheet has 0, a closed body 1/2.
constexpr double kEnclosed = 0.3;
/// Part of the area that must agree.
constexpr double kMajority = 0.8;
/// Where both sides have this part of the area, patches contradict each other.
constexpr double kContradiction = 0.2;

std::vector<double> even_parameters(std::size_t parts) {
  std::vector<double> parameters;
  for (std::size_t k = 0; k <= parts; ++k) parameters.push_back(static_cast<double>(k) / static_cast<double>(parts));
  return parameters;
}

/// Signed solid angle under which `facet` is seen from `point`, positive from behind, in parts of the whole sphere.
/// (van Oosterom and Strackee, The solid angle of a plane triangle, 1983.)
double winding(const Facet& facet, const Eigen::Vector3d& point) {
  const Eigen::Vector3d a = facet.a - point;
  const Eigen::Vector3d b = facet.b - point;
  const Eigen::Vector3d c = facet.c - point;
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  const double volume = a.dot(b.cross(c));
  const double denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return 2 * std::atan2(volume, denominator) / (4 * std::numbers::pi);
}

/// Area of the sampled facets, and of those from which the set's winding number is clearly positive or negative.
struct Votes {
  double area = 0, outward = 0, inward = 0;
};

/// The winding number of all facets, seen from the middles of some of them. A facet adds nothing at its own middle, so
/// that the number is the mean of both sides. The golden section spreads the samples evenly without falling into step
/// with the rows of the grid.
Votes collect_votes(const std::vector<Facet>& facets) {
  Votes votes;
  for (std::size_t sample = 1; sample <= kSamples; ++sample) {
    const double place = std::fmod(static_cast<double>(sample) / std::numbers::phi, 1.0);
    const auto k = static_cast<std::size_t>(place * static_cast<double>(facets.size()));
    const Eigen::Vector3d centre = facets[k].centre();
    double number = 0;
    for (std::size_t other = 0; other < facets.size(); ++other) {
      if (other != k) number += winding(facets[other], centre);
    }
    const double area = facets[k].area();
    votes.area += area;
    if (number > kEnclosed) votes.outward += area;
    if (number < -kEnclosed) votes.inward += area;
  }
  return votes;
}

/// Whether patches have the material on different sides.
bool contradict(const Votes& votes) { return std::min(votes.outward, votes.inward) >= kContradiction * votes.area; }

/// The side where nearly all of the votes agree.
std::optional<OutwardSide> agreed_side(const Votes& votes) {
  const double majority = std::max(votes.outward, votes.inward);
  if (majority < kMajority * votes.area) return std::nullopt;
  const bool plus = votes.outward > votes.inward;
  return OutwardSide{plus ? 1 : -1,
                     fmt::format("the surface closes around the material: from {:.0f} % of its area it is seen all "
                                 "around, and {}Su x Sv points out",
                                 100 * majority / votes.area, plus ? "" : "-")};
}

}  // namespace

SideVote vote_by_winding(const std::vector<NurbsSurface>& surfaces) {
  FacetedSurfaces faces = faceted(surfaces);
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    if (!surfaces[k].reversed) continue;
    for (std::size_t f = faces.first[k]; f < faces.first[k + 1]; ++f) std::swap(faces.facets[f].b, faces.facets[f].c);
  }
  const Votes votes = collect_votes(faces.facets);
  return {agreed_side(votes), contradict(votes)};
}

std::optional<OutwardSide> outward_side_of(const Surface& surface) {
  const std::size_t patches = surface.image().patches().size();
  const auto parts = static_cast<std::size_t>(std::sqrt(kCoarseFacets / static_cast<double>(patches)));
  const std::vector<double> parameters = even_parameters(std::max(parts, kLeastCounted));
  std::vector<Facet> facets;
  for (std::uint32_t patch = 0; patch < patches; ++patch) {
    const auto at = [&](double u, double v) -> Eigen::Vector3d {
      return surface.evaluate(surface.place_at(patch, u, v)).s;
    };
    const std::size_t first = facets.size();
    const auto in_face = [&](double u, double v) {
      return inside_face(surface.image(), surface.place_at(patch, u, v));
    };
    append_facets(parameters, parameters, at, in_face, facets);
    if (surface.image().patches()[patch].reversed == 0) continue;
    for (std::size_t k = first; k < facets.size(); ++k) std::swap(facets[k].b, facets[k].c);
  }
  return agreed_side(collect_votes(facets));
}

}  // namespace bladefit
