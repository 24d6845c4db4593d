#include "tools/batch/first_feet.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "core/geometry/nearest/global_projection.hpp"
#include "tools/batch/path_curve.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

Vec3 to_vec3(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

Vec3 at_start(const LocalizerConfig& config, const ProbePoint& point) {
  return apply(config.start, to_vec3(point.position));
}

SurfacePlace searched_place(const Surface& surface, const LocalizerConfig& config, const ProbePoint& point) {
  ProjectionQuery query;
  query.point = at_start(config, point);
  if (config.use_approach) query.approach = config.start.rotation * to_vec3(point.approach);
  return project_global(surface, query, nullptr).nearest.place;
}

/// The rows of each path, in the order of the points.
std::map<std::uint16_t, std::vector<std::size_t>> rows_by_path(const std::vector<ProbePoint>& points) {
  std::map<std::uint16_t, std::vector<std::size_t>> rows;
  for (std::size_t k = 0; k < points.size(); ++k) rows[points[k].path].push_back(k);
  return rows;
}

/// The foot of a curve as it is followed along it.
class CurveFoot {
 public:
  CurveFoot(const Surface& surface, std::uint32_t& searches) : surface_(surface), searches_(searches) {}

  SurfacePlace move_to(const Vec3& on_curve) {
    if (foot_) {
      foot_ = project_local(surface_, on_curve, foot_->place);
      if (foot_->converged && !foot_->outside && !foot_->fixed_u && !foot_->fixed_v) return foot_->place;
    }
    foot_ = project_global(surface_, {on_curve}, nullptr).nearest;
    ++searches_;
    return foot_->place;
  }

 private:
  const Surface& surface_;
  std::uint32_t& searches_;
  std::optional<Projection> foot_;
};

void check(Status status, const ProbePoint& point, const std::string& name) {
  if (status == Status::ok) return;
  const char* const fix = status == Status::out_of_range ? "it is over a thousand half sizes of the blade away, or "
                                                           "its direction is not a unit vector; correct it, or name "
                                                           "the unit of the points with --units"
                                                         : status_text(status);
  throw ToolError(fmt::format("{}: point {} cannot be used: {}", name, point.sequence, fix));
}

std::uint32_t stage_from_places(Localizer& localizer, const FirstPlaces& first, const std::vector<ProbePoint>& points,
                                const std::string& name) {
  for (std::size_t k = 0; k < points.size(); ++k)
    check(localizer.stage_from(points[k], first.places[k]), points[k], name);
  return first.searches;
}

std::uint32_t stage_from_neighbours(Localizer& localizer, const Surface& surface, const LocalizerConfig& config,
                                    const std::vector<ProbePoint>& points, const std::string& name) {
  std::uint32_t searches = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    SurfacePlace start;
    Verdict before;
    if (k > 0 && points[k].path == points[k - 1].path &&
        localizer.verdict_of(points[k - 1].sequence, before) == Status::ok) {
      start = surface.place_at(before.foot.patch, before.foot.u, before.foot.v);
    } else {
      start = searched_place(surface, config, points[k]);
      ++searches;
    }
    check(localizer.stage_from(points[k], start), points[k], name);
  }
  return searches;
}

}  // namespace

FootStarts parse_starts(const std::string& text) {
  for (std::size_t k = 1; k < kFootStartsWords.size(); ++k) {
    if (text == kFootStartsWords[k]) return static_cast<FootStarts>(k);
  }
  throw ToolError(fmt::format("--starts {}: give curves, neighbour or global", text));
}

FirstPlaces searched_places(const Surface& surface, const LocalizerConfig& config,
                            const std::vector<ProbePoint>& points) {
  FirstPlaces first;
  for (const ProbePoint& point : points) first.places.push_back(searched_place(surface, config, point));
  first.searches = static_cast<std::uint32_t>(points.size());
  return first;
}

FirstPlaces places_along_curves(const Surface& surface, const LocalizerConfig& config,
                                const std::vector<ProbePoint>& points) {
  FirstPlaces first;
  first.places.resize(points.size());
  for (const auto& [path, rows] : rows_by_path(points)) {
    std::vector<Vec3> positions;
    for (const std::size_t row : rows) positions.push_back(at_start(config, points[row]));
    const std::vector<Vec3> on_curve = places_on_curves(positions);
    CurveFoot foot(surface, first.searches);
    for (std::size_t k = 0; k < rows.size(); ++k) first.places[rows[k]] = foot.move_to(on_curve[k]);
  }
  return first;
}

std::uint32_t stage_points(Localizer& localizer, const Surface& surface, const LocalizerConfig& config,
                           const std::vector<ProbePoint>& points, FootStarts starts, const std::string& name) {
  switch (starts) {
    case FootStarts::global:
      return stage_from_places(localizer, searched_places(surface, config, points), points, name);
    case FootStarts::curves:
      return stage_from_places(localizer, places_along_curves(surface, config, points), points, name);
    case FootStarts::neighbour:
      return stage_from_neighbours(localizer, surface, config, points, name);
    case FootStarts::searched:
      break;
  }
  for (const ProbePoint& point : points) check(localizer.stage(point), point, name);
  return 0;
}

}  // namespace bladefit
