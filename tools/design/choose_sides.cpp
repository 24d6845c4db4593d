#include "tools/design/choose_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "tools/design/face_choice.hpp"
#include "tools/design/nurbs/sides_by_rays.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kListedFaces = 5;

/// "0 (UPPER), 3 and 12 more".
std::string list_of(const DesignFile& design, const std::vector<std::size_t>& faces) {
  std::string list;
  for (std::size_t k = 0; k < std::min(faces.size(), kListedFaces); ++k) {
    list += (k == 0 ? "" : ", ") + face_title(design, faces[k]);
  }
  return faces.size() > kListedFaces ? fmt::format("{} and {} more", list, faces.size() - kListedFaces) : list;
}

/// The side to which a face looks by its file: that of Su x Sv or the other.
int told_side(const NurbsSurface& surface) { return surface.reversed ? -1 : 1; }

/// Makes `sides` those of the surfaces.
OutwardSide take_sides(DesignFile& design, const std::vector<int>& sides, const std::string& reason) {
  const int sign = sides.front();
  for (std::size_t k = 0; k < sides.size(); ++k) design.surfaces[k].reversed = sides[k] != sign;
  return {sign, reason};
}

/// The faces on which the shape and `sides` do not agree; a side 0 agrees with all.
std::vector<std::size_t> disagreeing(const std::vector<int>& shape, const std::vector<int>& sides) {
  std::vector<std::size_t> faces;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (shape[k] * sides[k] < 0) faces.push_back(k);
  }
  return faces;
}

std::vector<int> told_sides(const DesignFile& design, int sign) {
  std::vector<int> sides;
  for (const NurbsSurface& surface : design.surfaces) sides.push_back(sign * told_side(surface));
  return sides;
}

[[noreturn]] void refuse_contradiction(const DesignFile& design, const std::string& file, const char* option,
                                       const std::vector<std::size_t>& faces) {
  throw ToolError(
      fmt::format("{}: the patches' normals do not all point to the same side of the material: by the shape patch {} "
                  "looks the other way; say {}, or the side of each, such as --outward {}:-,*:+",
                  file, list_of(design, faces), option, faces.front()));
}

/// Faces look the way that the shape tells. Where the file gives sides of its own, they must be those, or all opposite.
OutwardSide sides_by_shape(DesignFile& design, const std::string& file) {
  const std::vector<int> shape = sides_by_rays(design.surfaces);
  std::vector<int> sides = shape;
  std::vector<std::size_t> untold;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (sides[k] == 0) untold.push_back(k);
  }
  const bool told = std::ranges::all_of(design.faces, &DesignFace::told);
  if (untold.size() == sides.size() || (!untold.empty() && !told)) {
    throw ToolError(
        fmt::format("{}: the shape does not tell which side of patch {} is away from the material; say --outward + "
                    "(that of Su x Sv), --outward -, or a side for each, such as --outward {}:-,*:+",
                    file, list_of(design, untold), untold.front()));
  }
  if (told) {
    const std::vector<std::size_t> plus = disagreeing(shape, told_sides(design, 1)),
                                   minus = disagreeing(shape, told_sides(design, -1));
    if (!plus.empty() && !minus.empty()) refuse_contradiction(design, file, "--outward +", plus);
    return {plus.empty() ? 1 : -1, "the shape closes around the material on the side to which the file's faces look"};
  }
  std::vector<std::size_t> turned =
      disagreeing(sides, told_sides(design, sides.front() * told_side(design.surfaces[0])));
  return take_sides(design, sides,
                    turned.empty() ? "by the shape"
                                   : fmt::format("by the shape; patch {} has it on the other side of Su x Sv",
                                                 list_of(design, turned)));
}

OutwardSide automatic_side(DesignFile& design, const std::string& file) {
  const SideVote vote = vote_by_winding(design.surfaces);
  if (vote.side) return *vote.side;
  if (std::ranges::all_of(design.faces, &DesignFace::in_body)) {
    return {1, "that to which the faces of the file's closed shells look"};
  }
  return sides_by_shape(design, file);
}

OutwardSide side_as_asked(DesignFile& design, int sign, const std::string& file) {
  if (design.surfaces.size() > 1 && vote_by_winding(design.surfaces).contradiction) {
    const std::vector<std::size_t> faces = disagreeing(sides_by_rays(design.surfaces), told_sides(design, sign));
    if (!faces.empty() && faces.size() < design.surfaces.size()) {
      refuse_contradiction(design, file, "--outward auto", faces);
    }
  }
  return {sign, "as asked"};
}

/// The sides of a list; of faces that it does not name, those of the shape.
OutwardSide listed_sides(DesignFile& design, std::span<const FaceSide> list, const std::string& file) {
  std::vector<int> sides(design.surfaces.size(), 0);
  for (const FaceSide& entry : list) {
    for (const std::size_t k : faces_named(design, entry.face, file)) {
      if (sides[k] == 0) sides[k] = (entry.plus ? 1 : -1) * told_side(design.surfaces[k]);
    }
  }
  if (std::ranges::find(sides, 0) == sides.end()) return take_sides(design, sides, "as asked, face by face");
  const std::vector<int> shape = sides_by_rays(design.surfaces);
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (sides[k] == 0) sides[k] = shape[k];
    if (sides[k] != 0) continue;
    throw ToolError(
        fmt::format("{}: the shape does not tell which side of patch {} is away from the material; name it "
                    "in --outward as well, or add *:+",
                    file, face_title(design, k)));
  }
  return take_sides(design, sides, "as asked, face by face; of those not named by the shape");
}

}  // namespace

OutwardSide choose_sides(DesignFile& design, const OutwardChoice& asked, const std::string& file) {
  if (!asked.faces.empty()) return listed_sides(design, asked.faces, file);
  if (asked.all == OutwardOption::automatic) return automatic_side(design, file);
  return side_as_asked(design, asked.all == OutwardOption::plus ? 1 : -1, file);
}

}  // namespace bladefit
