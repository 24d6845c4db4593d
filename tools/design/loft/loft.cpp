#include "tools/design/loft/loft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/nearest/global_projection.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/loft/spline_fit.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kPointsPerKnot = 3;

std::size_t fewest_points(const BladeSections& sections) {
  return std::min_element(sections.sections.begin(), sections.sections.end(),
                          [](const auto& a, const auto& b) { return a.points.size() < b.points.size(); })
      ->points.size();
}

void check_degree(const char* option, int degree) {
  if (degree >= 1 && degree <= static_cast<int>(kMaxDegree)) return;
  throw ToolError(fmt::format("{} {}: give a degree from 1 to {}", option, degree, kMaxDegree));
}

void check_knots(const LoftSettings& settings) {
  if (!settings.knots.empty() && (settings.control_points || settings.follow_points)) {
    throw ToolError(fmt::format("--{} and --knots: give one of them, not both",
                                settings.control_points ? "control-points" : "follow-points"));
  }
  double before = 0;
  for (const double knot : settings.knots) {
    if (!(knot > 0 && knot < 1 && knot >= before)) {
      throw ToolError(fmt::format("--knots {}: give internal knots above 0 and below 1, rising", knot));
    }
    before = knot;
  }
}

/// Control points along a section.
int control_point_count(const BladeSections& sections, const LoftSettings& settings) {
  if (!settings.knots.empty()) return settings.degree + 1 + static_cast<int>(settings.knots.size());
  const int count = settings.control_points.value_or(default_control_points(sections, settings.degree));
  if (count > settings.degree) return count;
  throw ToolError(fmt::format("--control-points {}: a curve of degree {} has at least {}", count, settings.degree,
                              settings.degree + 1));
}

/// Where a section begins, or ends, in its file; the file alone where it is made from a table.
std::string place_of(const BladeSections& sections, const BladeSection& section, bool end = false) {
  if (section.lines.empty()) return sections.file;
  return fmt::format("{}:{}", sections.file, end ? section.lines.back() : section.lines.front());
}

void check_counts(const BladeSections& sections, const LoftSettings& settings, int control_points) {
  const std::size_t count = sections.sections.size();
  if (count <= static_cast<std::size_t>(settings.span_degree)) {
    throw ToolError(
        fmt::format("{}: {} sections are too few for degree {} over them, which needs {}; add sections "
                    "or lower --span-degree",
                    sections.file, count, settings.span_degree, settings.span_degree + 1));
  }
  for (const BladeSection& section : sections.sections) {
    if (section.points.size() >= static_cast<std::size_t>(control_points)) continue;
    throw ToolError(
        fmt::format("{}: section {} has {} points, too few for {} control points; add points or take "
                    "fewer control points",
                    place_of(sections, section, true), section.name, section.points.size(), control_points));
  }
}

std::vector<long double> parameters_of(const BladeSections& sections, const BladeSection& section,
                                       const std::vector<ExtendedPoint>& points) {
  auto parameters = chord_parameters(points);
  if (parameters) return *std::move(parameters);
  throw ToolError(fmt::format("{}: all points of section {} are the same; give points along the section",
                              place_of(sections, section), section.name));
}

std::vector<ExtendedPoint> points_of(const BladeSection& section) {
  std::vector<ExtendedPoint> points;
  for (const Eigen::Vector3d& point : section.points) points.emplace_back(point.cast<long double>());
  return points;
}

/// The internal knots along the sections.
std::vector<double> section_knots(const BladeSections& sections, const LoftSettings& settings, int count) {
  if (!settings.knots.empty()) return settings.knots;
  const int knots = count - settings.degree - 1;
  if (!settings.follow_points) return uniform_knots(knots);
  std::vector<double> mean(static_cast<std::size_t>(knots), 0.0);
  for (const BladeSection& section : sections.sections) {
    const std::vector<double> own = averaged_knots(parameters_of(sections, section, points_of(section)), knots);
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += own[k] / static_cast<double>(sections.sections.size());
  }
  return mean;
}

/// The internal knots over `count` sections.
std::vector<double> span_knots(const LoftSettings& settings, std::size_t count) {
  const int degree = settings.span_degree, knots = static_cast<int>(count) - degree - 1;
  if (!settings.knots_at_sections) return uniform_knots(knots);
  std::vector<double> means;  // of the parameters of sections j to j + degree - 1
  for (int j = 1; j <= knots; ++j) means.push_back((j + 0.5 * (degree - 1)) / static_cast<double>(count - 1));
  return means;
}

std::vector<ExtendedPoint> fit_section(const BladeSections& sections, const BladeSection& section,
                                       const SurfaceDirection& direction) {
  const std::vector<ExtendedPoint> points = points_of(section);
  auto controls = fit_spline(direction, parameters_of(sections, section, points), points);
  if (controls) return *std::move(controls);
  throw ToolError(
      fmt::format("{}: section {} has no points between some knots, so that the curve is not "
                  "determined; lower --control-points or place --knots where points are",
                  place_of(sections, section), section.name));
}

/// The splines over the sections through their control points: column j holds control points (0, j), (1, j), ...
std::vector<ExtendedPoint> fit_column(const std::vector<std::vector<ExtendedPoint>>& curves, std::size_t j,
                                      const SurfaceDirection& direction) {
  std::vector<long double> parameters;
  std::vector<ExtendedPoint> points;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    parameters.push_back(static_cast<long double>(k) / static_cast<long double>(curves.size() - 1));
    points.push_back(curves[k][j]);
  }
  auto controls = fit_spline(direction, parameters, points);
  if (controls) return *std::move(controls);
  throw ToolError(fmt::format("--span-degree {}: {} sections do not determine the surface; lower it", direction.degree,
                              curves.size()));
}

}  // namespace

int default_control_points(const BladeSections& sections, int degree) {
  const int knots = static_cast<int>(fewest_points(sections) / kPointsPerKnot);
  return std::max(knots - degree - 1, degree + 1);
}

NurbsSurface loft(const BladeSections& sections, const LoftSettings& settings, double mm_per_unit) {
  check_degree("--degree", settings.degree);
  check_degree("--span-degree", settings.span_degree);
  NurbsSurface surface;
  surface.name = "lofted surface";
  check_knots(settings);
  const int count = control_point_count(sections, settings);
  check_counts(sections, settings, count);
  surface.v = clamped_direction(settings.degree, section_knots(sections, settings, count));
  surface.u = clamped_direction(settings.span_degree, span_knots(settings, sections.sections.size()));
  std::vector<std::vector<ExtendedPoint>> curves;
  for (const BladeSection& section : sections.sections) curves.push_back(fit_section(sections, section, surface.v));
  const auto count_v = static_cast<std::size_t>(surface.v.control_points);
  surface.control_points.resize(curves.size() * count_v);
  surface.weights.assign(curves.size() * count_v, 1.0);
  for (std::size_t j = 0; j < count_v; ++j) {
    const std::vector<ExtendedPoint> column = fit_column(curves, j, surface.u);
    // Rounded in the unit of the file before it is turned to mm, so that a file in that unit holds the same numbers.
    for (std::size_t i = 0; i < column.size(); ++i) {
      surface.control_points[i * count_v + j] = mm_per_unit * column[i].cast<double>();
    }
  }
  check_surface(surface, sections.file);
  return surface;
}

LoftDeviation loft_deviation(const NurbsSurface& surface, const BladeSections& sections, double mm_per_unit) {
  // The side of the material plays no part: the points have no directions.
  const std::vector<std::byte> image = write_image({surface}, DesignUnit::mm, 1);
  DesignImage design;
  if (const Status status = DesignImage::open(image, design); status != Status::ok) {
    throw ToolError(fmt::format("{}: the lofted surface is not valid: {}; look for points that are far off",
                                sections.file, status_text(status)));
  }
  LoftDeviation deviation;
  double sum = 0;
  for (std::size_t s = 0; s < sections.sections.size(); ++s) {
    const BladeSection& section = sections.sections[s];
    for (std::size_t k = 0; k < section.points.size(); ++k, ++deviation.points) {
      const ProjectionQuery query{mm_per_unit * section.points[k], Vec3::Zero(), 0};
      const double squared = project_global(Surface(design), query, nullptr).nearest.distance_squared();
      sum += squared;
      if (std::sqrt(squared) <= deviation.largest_mm) continue;
      deviation.largest_mm = std::sqrt(squared);
      deviation.section = s;
      deviation.point = k;
    }
  }
  deviation.rms_mm = std::sqrt(sum / static_cast<double>(deviation.points));
  return deviation;
}

}  // namespace bladefit
