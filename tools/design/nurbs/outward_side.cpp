#include "tools/design/nurbs/outward_side.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/design/nurbs/bezier_extraction.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// Facets a patch is divided into, in each direction, at least; spans with more knots get one a span.
constexpr std::size_t kFacets = 32;
/// Pairs of facets of a whole design that is looked at coarsely, and parts of each direction of a patch there at least.
constexpr double kCoarseFacets = 600;
constexpr std::size_t kLeastParts = 4;
/// Points from which the winding number is taken.
constexpr std::size_t kSamples = 160;
/// From where on a winding number counts as "enclosed". An open sheet has 0, a closed body 1/2.
constexpr double kEnclosed = 0.3;
/// Part of the area that must agree.
constexpr double kMajority = 0.8;
/// Where both sides have this part of the area, patches contradict each other.
constexpr double kContradiction = 0.2;

struct Facet {
  Eigen::Vector3d a, b, c;

  [[nodiscard]] Eigen::Vector3d centre() const { return (a + b + c) / 3; }
  [[nodiscard]] double area() const { return (b - a).cross(c - a).norm() / 2; }
};

/// Point of a Bezier patch at the normalised parameters, by de Casteljau.
Eigen::Vector3d evaluate(const BezierPatch& patch, double u, double v) {
  const auto locate = [](const std::vector<double>& breaks, double t) {
    const auto above = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, t);
    return static_cast<std::size_t>(above - breaks.begin()) - 1;
  };
  const auto reduce = [](std::vector<Eigen::Vector4d> points, double t) {
    for (std::size_t last = points.size() - 1; last > 0; --last) {
      for (std::size_t k = 0; k < last; ++k) points[k] = (1 - t) * points[k] + t * points[k + 1];
    }
    return points.front();
  };
  const std::size_t iu = locate(patch.breaks_u, u);
  const std::size_t iv = locate(patch.breaks_v, v);
  const double s = (u - patch.breaks_u[iu]) / (patch.breaks_u[iu + 1] - patch.breaks_u[iu]);
  const double t = (v - patch.breaks_v[iv]) / (patch.breaks_v[iv + 1] - patch.breaks_v[iv]);
  const double* net = &patch.coefficients[(iu * patch.spans_v() + iv) * patch.span_size()];
  std::vector<Eigen::Vector4d> column;
  for (int i = 0; i <= patch.degree_u; ++i) {
    std::vector<Eigen::Vector4d> row;
    for (int j = 0; j <= patch.degree_v; ++j) row.emplace_back(net + 4 * (i * (patch.degree_v + 1) + j));
    column.push_back(reduce(row, t));
  }
  const Eigen::Vector4d point = reduce(column, s);
  return point.head<3>() / point.w();
}

/// Parameters of the facet corners: every break (or some, where there are hundreds), and points between.
std::vector<double> facet_parameters(const std::vector<double>& breaks) {
  const std::size_t spans = breaks.size() - 1;
  const std::size_t parts = (kFacets + spans - 1) / spans;
  const std::size_t stride = (spans + 2 * kFacets - 1) / (2 * kFacets);
  std::vector<double> parameters;
  for (std::size_t k = 0; k < spans; k += stride) {
    const double next = breaks[std::min(k + stride, spans)];
    for (std::size_t part = 0; part < parts; ++part) {
      parameters.push_back(breaks[k] + (next - breaks[k]) * static_cast<double>(part) / static_cast<double>(parts));
    }
  }
  parameters.push_back(1.0);
  return parameters;
}

/// The facets between points at every pair of parameters; at(u, v) is a point.
template <class At>
void append_facets(const std::vector<double>& us, const std::vector<double>& vs, At at, std::vector<Facet>& facets) {
  std::vector<Eigen::Vector3d> points;
  for (const double u : us) {
    for (const double v : vs) points.push_back(at(u, v));
  }
  const auto point = [&](std::size_t i, std::size_t j) { return points[i * vs.size() + j]; };
  for (std::size_t i = 0; i + 1 < us.size(); ++i) {
    for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
      facets.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
      facets.push_back({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
    }
  }
}

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

OutwardSide find_outward_side(const std::vector<NurbsSurface>& surfaces, const std::string& file) {
  std::vector<Facet> facets;
  for (const NurbsSurface& surface : surfaces) {
    const BezierPatch patch = extract_bezier(surface);
    append_facets(
        facet_parameters(patch.breaks_u), facet_parameters(patch.breaks_v),
        [&patch](double u, double v) { return evaluate(patch, u, v); }, facets);
  }
  const Votes votes = collect_votes(facets);
  if (const std::optional<OutwardSide> side = agreed_side(votes)) return *side;
  if (contradict(votes)) {
    throw ToolError(
        fmt::format("{}: the patches' normals do not all point to the same side of the material; reverse "
                    "the wrong ones in the CAD system",
                    file));
  }
  throw ToolError(
      fmt::format("{}: the shape does not tell which side is away from the material; say --outward + (that "
                  "of Su x Sv) or --outward -",
                  file));
}

std::optional<OutwardSide> outward_side_of(const Surface& surface) {
  const std::size_t patches = surface.image().patches().size();
  const auto parts = static_cast<std::size_t>(std::sqrt(kCoarseFacets / static_cast<double>(patches)));
  const std::vector<double> parameters = even_parameters(std::max(parts, kLeastParts));
  std::vector<Facet> facets;
  for (std::uint32_t patch = 0; patch < patches; ++patch) {
    const auto at = [&](double u, double v) -> Eigen::Vector3d {
      return surface.evaluate(surface.place_at(patch, u, v)).s;
    };
    append_facets(parameters, parameters, at, facets);
  }
  return agreed_side(collect_votes(facets));
}

}  // namespace bladefit
