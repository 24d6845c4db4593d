#include "tools/design/iges/iges_solid_places.hpp"

#include <fmt/format.h>

#include "tools/design/occ/affine_place.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr int kSolid = 186, kShell = 514, kFace = 510;

/// Where the parameters of a solid or a shell name what it is made of.
std::vector<std::size_t> part_places(const IgesEntity& entity, const IgesParameters& parameters) {
  const std::size_t count_at = entity.type == kSolid ? 3 : 1;
  std::vector<std::size_t> places;
  if (entity.type == kSolid) places.push_back(1);
  if (count_at >= parameters.size()) return places;
  const double count = parse_iges_real(parameters.text(count_at)).value_or(0);
  for (std::size_t k = 0; static_cast<double>(k) < count; ++k) places.push_back(count_at + 1 + 2 * k);
  return places;
}

bool is_turn_or_mirror(const Eigen::Affine3d& place) {
  constexpr double kRounding = 1e-4;
  return (place.linear() * place.linear().transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kRounding;
}

}  // namespace

IgesSolidPlaces::IgesSolidPlaces(const CleanIges& iges, const std::string& file)
    : iges_(iges), file_(file), parents_(iges.entities.size()) {
  for (std::size_t k = 0; k < iges.entities.size(); ++k) {
    const int type = iges.entities[k].type;
    if (type == kSolid || type == kShell) note_parents(k, part_places(iges.entities[k], iges.parameters[k]));
  }
}

void IgesSolidPlaces::note_parents(std::size_t parent, const std::vector<std::size_t>& places) {
  for (const std::size_t place : places) {
    if (place >= iges_.parameters[parent].size()) return;
    const double number = parse_iges_real(iges_.parameters[parent].text(place)).value_or(0);
    if (number >= 1) parents_[static_cast<std::size_t>(number) / 2].push_back(parent);
  }
}

Eigen::Affine3d IgesSolidPlaces::matrix_of(std::size_t index) const {
  Eigen::Affine3d whole = Eigen::Affine3d::Identity();
  for (int number = iges_.entities[index].matrix; number != 0;) {
    const auto matrix = static_cast<std::size_t>(number) / 2;
    Eigen::Affine3d own = Eigen::Affine3d::Identity();
    for (int k = 0; k < 12; ++k) own(k / 4, k % 4) = iges_.parameters[matrix].real(static_cast<std::size_t>(k + 1));
    own.translation() *= iges_.global.unit.mm;
    if (!is_turn_or_mirror(own)) refuse(matrix, "its axes are not square or not of length 1, and it places a solid");
    whole = own * whole;
    number = iges_.entities[matrix].matrix;
  }
  return whole;
}

std::optional<Eigen::Affine3d> IgesSolidPlaces::place_of(std::size_t index) const {
  const Eigen::Affine3d own = matrix_of(index);
  std::optional<Eigen::Affine3d> outer;
  for (const std::size_t parent : parents_[index]) {
    const Eigen::Affine3d place = place_of(parent).value_or(Eigen::Affine3d::Identity());
    if (outer && !outer->matrix().isApprox(place.matrix(), 0)) {
      refuse(index, "two solids with matrices of their own share it");
    }
    outer = place;
  }
  const Eigen::Affine3d whole = outer.value_or(Eigen::Affine3d::Identity()) * own;
  return whole.matrix().isIdentity(0) ? std::nullopt : std::optional(whole);
}

void IgesSolidPlaces::place(std::size_t index, CadFace& face) const {
  if (iges_.entities[index].type != kFace) return;
  const std::optional<Eigen::Affine3d> left_out = place_of(index);
  if (!left_out) return;
  const double surface = parse_iges_real(iges_.parameters[index].text(1)).value_or(0);
  if (surface >= 1 && iges_.entities[static_cast<std::size_t>(surface) / 2].matrix != 0) {
    refuse(index, "both its surface and its solid have a matrix");
  }
  face.place = affine_of(face.face.Location().Transformation()) * *left_out;
  face.face.Location(TopLoc_Location());
}

void IgesSolidPlaces::refuse(std::size_t index, const std::string& what) const {
  throw ToolError(fmt::format("{}: entity {} at D{}: {}; export the blade as trimmed surfaces (144)", file_,
                              iges_.entities[index].type, iges_.entities[index].directory_number, what));
}

}  // namespace bladefit
