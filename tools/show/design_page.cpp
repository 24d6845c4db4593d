#include "tools/show/design_page.hpp"

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tools/report/report_text.hpp"
#include "tools/show/base64.hpp"
#include "tools/show/page_text.hpp"

namespace bladefit {
namespace {

using Json = nlohmann::json;

constexpr std::array<const char*, 5> kLineKinds = {"edge", "u", "v", "ring", "ridge"};

template <class Number>
std::string packed(const std::vector<Number>& numbers) {
  return base64(std::as_bytes(std::span(numbers)));
}

std::string packed_parameters(const std::vector<double>& parameters) {
  return packed(std::vector<float>(parameters.begin(), parameters.end()));
}

/// Places about the middle of the page, in its units.
class Places {
 public:
  Places(const Vec3& middle, double mm_per_unit) : middle_(middle), mm_per_unit_(mm_per_unit) {}

  [[nodiscard]] Vec3 of(const Vec3& place) const { return (place - middle_) / mm_per_unit_; }
  [[nodiscard]] Json json(const Vec3& place) const { return std::array{of(place).x(), of(place).y(), of(place).z()}; }
  [[nodiscard]] std::string packed_places(const std::vector<Vec3>& places) const {
    std::vector<float> numbers;
    numbers.reserve(3 * places.size());
    for (const Vec3& place : places) {
      for (const double number : of(place)) numbers.push_back(static_cast<float>(number));
    }
    return packed(numbers);
  }

 private:
  Vec3 middle_;
  double mm_per_unit_;
};

Json vector_json(const Vec3& vector) { return std::array{vector.x(), vector.y(), vector.z()}; }

Json mesh_json(const FaceMesh& mesh, const Places& places) {
  std::vector<std::int8_t> normals;
  normals.reserve(3 * mesh.normals.size());
  for (const Vec3& normal : mesh.normals) {
    for (const double part : normal) normals.push_back(static_cast<std::int8_t>(std::lround(127.0 * part)));
  }
  return {{"patch", mesh.patch},
          {"u", packed_parameters(mesh.us)},
          {"v", packed_parameters(mesh.vs)},
          {"places", places.packed_places(mesh.points)},
          {"normals", packed(normals)}};
}

Json line_json(const PageLine& line, const Places& places) {
  Json json = {{"kind", kLineKinds.at(static_cast<std::size_t>(line.kind))}, {"patch", line.patch}};
  if (!line.ends.empty()) json["ends"] = places.packed_places(line.ends);
  if (!line.label.empty()) {
    json["label"] = line.label;
    json["place"] = places.json(line.label_place);
    if (line.label_normal != Vec3::Zero()) json["normal"] = vector_json(line.label_normal);
  }
  return json;
}

Json points_json(const PageContent& content, const Places& places) {
  std::vector<Vec3> stands;
  std::vector<float> feet;
  std::vector<std::uint32_t> numbers;
  std::vector<std::uint8_t> zones;
  for (const PagePoint& point : content.points) {
    stands.push_back(point.place);
    numbers.push_back(static_cast<std::uint32_t>(point.number));
    zones.push_back(static_cast<std::uint8_t>(point.zone != 0 ? point.zone : point.in_zone ? 1 : 0));
    for (const double number :
         {static_cast<double>(point.patch), point.u, point.v, point.distance / content.mm_per_unit})
      feet.push_back(static_cast<float>(number));
  }
  return {{"places", places.packed_places(stands)},
          {"numbers", packed(numbers)},
          {"zones", packed(zones)},
          {"feet", packed(feet)}};
}

/// The middle of the box of all faces [mm].
Vec3 middle_of_faces(const PageContent& content) {
  Eigen::AlignedBox3d box;
  for (const FaceMesh& face : content.faces) {
    for (const Vec3& point : face.points) box.extend(point);
  }
  return box.center();
}

Json content_json(const PageContent& content) {
  const Vec3 middle = middle_of_faces(content);
  const Places places(middle, content.mm_per_unit);
  Json json = {
      {"title", content.title},
      {"units", content.units},
      {"middle", vector_json(middle / content.mm_per_unit)},
      {"axis", {{"point", places.json(content.axis.point)}, {"direction", vector_json(content.axis.direction)}}},
      {"radius", content.tip_radius_mm / content.mm_per_unit},
      {"names", content.names},
      {"notes", content.notes},
      {"points", points_json(content, places)}};
  for (const char* list : {"faces", "zones", "lines"}) json[list] = Json::array();
  for (const FaceMesh& face : content.faces) json["faces"].push_back(mesh_json(face, places));
  for (const FaceMesh& zone : content.zones) {
    json["zones"].push_back(mesh_json(zone, places));
    if (zone.zone != 0) json["zones"].back()["zone"] = zone.zone;
  }
  if (!content.zone_names.empty()) json["zone_names"] = content.zone_names;
  for (const PageLine& line : content.lines) json["lines"].push_back(line_json(line, places));
  return json;
}

/// JSON that may stand inside of a script: no `<` ends it.
std::string script_text(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

/// The page with what belongs in the place of each {{mark}}.
std::string filled(std::string_view page, const std::map<std::string, std::string, std::less<>>& texts) {
  std::string out;
  while (true) {
    const std::size_t open = page.find("{{"), close = page.find("}}", open);
    out += page.substr(0, open);
    if (close == std::string_view::npos) return out;
    out += texts.find(page.substr(open + 2, close - open - 2))->second;
    page.remove_prefix(close + 2);
  }
}

}  // namespace

std::string design_page(const PageContent& content) {
  return filled(page_text(), {{"title", escaped(content.title)},
                              {"script", std::string(page_script())},
                              {"content", script_text(content_json(content))}});
}

}  // namespace bladefit
