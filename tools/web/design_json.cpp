#include "tools/web/design_json.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/geometry/surface/trim.hpp"
#include "tools/show/base64.hpp"
#include "tools/show/face_mesh.hpp"
#include "tools/web/edge_limits.hpp"
#include "tools/web/json_text.hpp"

namespace bladefit {
namespace {

constexpr double kFullByte = 127;

template <class Number>
std::string base64_of(const std::vector<Number>& numbers) {
  return base64(std::as_bytes(std::span(numbers)));
}

std::string triple(const Vec3& vector) {
  return json_list(std::array{vector.x(), vector.y(), vector.z()}, json_number);
}

/// 1 for each point of the grid that lies in its face, whose trims may leave parts of it out.
std::vector<std::uint8_t> inside_of(const Surface& surface, const FaceMesh& mesh) {
  std::vector<std::uint8_t> inside;
  inside.reserve(mesh.points.size());
  for (const double u : mesh.us) {
    for (const double v : mesh.vs)
      inside.push_back(inside_face(surface.image(), surface.place_at(mesh.patch, u, v)) ? 1 : 0);
  }
  return inside;
}

std::string grid_json(const Surface& surface, const FaceMesh& mesh) {
  std::vector<float> places;
  std::vector<std::int8_t> normals;
  places.reserve(3 * mesh.points.size());
  normals.reserve(3 * mesh.normals.size());
  for (const Vec3& point : mesh.points) {
    for (const double part : Vec3(point - surface.middle())) places.push_back(static_cast<float>(part));
  }
  for (const Vec3& normal : mesh.normals) {
    for (const double part : normal) normals.push_back(static_cast<std::int8_t>(std::lround(kFullByte * part)));
  }
  return fmt::format(R"({{"rows":{},"columns":{},"places":"{}","normals":"{}","inside":"{}"}})", mesh.us.size(),
                     mesh.vs.size(), base64_of(places), base64_of(normals), base64_of(inside_of(surface, mesh)));
}

std::string limits_json(const EdgeLimits& limits, double tip_radius_mm) {
  return fmt::format(R"({{"from":{},"to":{},"plus":{},"minus":{}}})", json_number(limits.low_mm / tip_radius_mm),
                     json_number(limits.high_mm / tip_radius_mm), json_number(limits.limits.plus()),
                     json_number(limits.limits.minus()));
}

}  // namespace

std::string design_json(const Surface& surface, const ToleranceMap& tolerance, const ShaftAxis& axis,
                        double tip_radius_mm, const std::string& name) {
  const std::vector<FaceMesh> faces = mesh_faces(surface);
  const auto grid = [&surface](const FaceMesh& mesh) { return grid_json(surface, mesh); };
  std::vector<FaceMesh> zones;
  for (std::uint32_t k = 0; k < tolerance.box_count; ++k) {
    const ParameterBox& box = tolerance.boxes.at(k);
    const FaceMesh& face = faces.at(box.patch);
    zones.push_back(mesh_inside(surface, face, box));
  }
  const auto piece = [tip_radius_mm](const EdgeLimits& limits) { return limits_json(limits, tip_radius_mm); };
  return fmt::format(
      R"({{"name":{},"middle":{},"half_diagonal":{},"axis":{{"point":{},"direction":{}}},"tip":{},"faces":{},"zones":{},)"
      R"("edge_limits":{}}})",
      json_text(name), triple(surface.middle()), json_number(surface.half_diagonal()), triple(axis.point),
      triple(axis.direction), json_number(tip_radius_mm), json_list(faces, grid), json_list(zones, grid),
      json_list(edge_limits(tolerance, zones), piece));
}

}  // namespace bladefit
