#include "tools/design/iges/iges_references.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "tools/design/text/reference_circle.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr int kLargestCount = 10000000;
constexpr int kMatrix = 124;

/// Where the references of an entity type stand among its parameters (IGES 5.3, section 4): some at fixed places, then
/// a list of `width` parameters an element, of which those at `at` are references, with its count at `count`.
struct ReferencePlaces {
  int type;
  std::array<std::size_t, 3> fixed;  ///< 0 = none
  std::size_t count, list, width, at;
};
constexpr std::array<ReferencePlaces, 25> kPlaces = {{
    {102, {}, 1, 2, 1, 0},         // composite curve
    {108, {5}, 0, 0, 0, 0},        // plane and its boundary
    {118, {1, 2}, 0, 0, 0, 0},     // ruled surface
    {120, {1, 2}, 0, 0, 0, 0},     // surface of revolution
    {122, {1}, 0, 0, 0, 0},        // tabulated cylinder
    {130, {1}, 0, 0, 0, 0},        // offset curve
    {140, {5}, 0, 0, 0, 0},        // offset surface
    {142, {2, 3, 4}, 0, 0, 0, 0},  // curve on a surface
    {143, {2}, 3, 4, 1, 0},        // bounded surface
    {144, {1, 4}, 3, 5, 1, 0},     // trimmed surface
    {186, {1}, 3, 4, 2, 0},        // solid
    {190, {1, 2, 3}, 0, 0, 0, 0},  // plane surface
    {192, {1, 2, 4}, 0, 0, 0, 0},  // cylinder
    {194, {1, 2, 5}, 0, 0, 0, 0},  // cone
    {196, {1, 3, 4}, 0, 0, 0, 0},  // sphere
    {198, {1, 2, 5}, 0, 0, 0, 0},  // torus
    {308, {}, 3, 4, 1, 0},         // subfigure
    {402, {}, 1, 2, 1, 0},         // group
    {408, {1}, 0, 0, 0, 0},        // instance of a subfigure
    {141, {3}, 0, 0, 0, 0},        // boundary
    {504, {}, 1, 2, 5, 0},         // edges
    {510, {1}, 2, 4, 1, 0},        // face
    {514, {}, 1, 2, 2, 0},         // shell
    {184, {}, 1, 2, 1, 0},         // assembly of solids
    {430, {1}, 0, 0, 0, 0},        // instance of a solid
}};
/// Forms of 402 that are groups; others list other things.
constexpr std::array<int, 4> kGroupForms = {1, 7, 14, 15};

/// Appends the entity to which a parameter refers; 0 or left out = none.
void append_target(const IgesParameters& parameters, std::size_t place, std::size_t entities,
                   std::vector<std::uint32_t>& targets) {
  if (place >= parameters.size() || parameters.text(place).empty()) return;
  const int number = parameters.integer(place, "a reference", -kLargestCount, kLargestCount);
  if (number == 0) return;
  const auto index = static_cast<std::size_t>(std::abs(number)) / 2;
  if (std::abs(number) % 2 == 0 || index >= entities) {
    parameters.fail(fmt::format("parameter {} refers to D{}, which is not in the file", place, std::abs(number)));
  }
  targets.push_back(static_cast<std::uint32_t>(index));
}

void append_targets(const IgesEntity& entity, const IgesParameters& parameters, std::size_t entities,
                    std::vector<std::uint32_t>& targets) {
  const auto places = std::ranges::find(kPlaces, entity.type, &ReferencePlaces::type);
  if (places == kPlaces.end()) return;
  if (entity.type == 402 && std::ranges::find(kGroupForms, entity.form) == kGroupForms.end()) return;
  for (const std::size_t place : places->fixed) {
    if (place != 0) append_target(parameters, place, entities, targets);
  }
  if (places->count == 0 || places->count >= parameters.size()) return;
  const auto count = static_cast<std::size_t>(parameters.integer(places->count, "a count", 0, kLargestCount));
  const std::size_t last = places->list + places->width * count;
  if (last > parameters.size()) {
    parameters.fail(fmt::format("{} parameters where its list of {} needs {}", parameters.size(), count, last));
  }
  for (std::size_t k = 0; k < count; ++k) {
    append_target(parameters, places->list + places->width * k + places->at, entities, targets);
  }
}

/// The matrix of an entity must be one, and a matrix that has a matrix must not lead back.
void append_matrix(const std::vector<IgesEntity>& entities, std::size_t k, const std::string& file,
                   std::vector<std::uint32_t>& targets) {
  const int number = entities[k].matrix;
  if (number == 0) return;
  const auto index = static_cast<std::size_t>(number) / 2;
  const bool exists = number > 0 && number % 2 == 1 && index < entities.size();
  if (!exists || entities[index].type != kMatrix) {
    throw ToolError(
        fmt::format("{}: entity {} at D{}: its transformation matrix D{} is not an entity 124; export the design again",
                    file, entities[k].type, entities[k].directory_number, number));
  }
  targets.push_back(static_cast<std::uint32_t>(index));
}

}  // namespace

void check_iges_references(const std::vector<IgesEntity>& entities, const std::vector<IgesParameters>& parameters,
                           const std::string& file) {
  ReferenceGraph graph;
  for (std::size_t k = 0; k < entities.size(); ++k) {
    append_targets(entities[k], parameters[k], entities.size(), graph.targets);
    append_matrix(entities, k, file, graph.targets);
    graph.first.push_back(graph.targets.size());
  }
  const auto circle = find_circle(graph);
  if (!circle) return;
  const IgesEntity& entity = entities[graph.targets[*circle]];
  throw ToolError(fmt::format("{}: entity {} at D{} refers to itself; export the design again", file, entity.type,
                              entity.directory_number));
}

std::vector<std::size_t> iges_parts(const std::vector<IgesEntity>& entities,
                                    const std::vector<IgesParameters>& parameters, std::size_t index) {
  std::set<std::size_t> seen = {index};
  std::vector<std::size_t> parts = {index};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    std::vector<std::uint32_t> targets;
    append_targets(entities[parts[k]], parameters[parts[k]], entities.size(), targets);
    for (const std::uint32_t target : targets) {
      if (seen.insert(target).second) parts.push_back(target);
    }
  }
  parts.erase(parts.begin());
  return parts;
}

}  // namespace bladefit
