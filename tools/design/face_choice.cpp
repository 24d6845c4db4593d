#include "tools/design/face_choice.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// Trimmed planes of more than this share of a design's area are its sides, no caps that close it.
constexpr double kLargestCaps = 0.2;

/// Faces that a message lists.
constexpr std::size_t kListed = 3;

std::optional<std::size_t> number_of(std::string_view text) {
  std::size_t number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc() && !text.empty() && stop == text.data() + text.size();
  return whole ? std::optional(number) : std::nullopt;
}

bool matches(const std::string& pattern, const std::string& text) {
  return !text.empty() && fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
}

}  // namespace

std::string face_title(const DesignFile& design, std::size_t face) {
  const std::string& name = design.faces[face].name;
  return name.empty() ? fmt::format("{}", face) : fmt::format("{} ({})", face, name);
}

std::vector<std::size_t> faces_named(const DesignFile& design, std::string_view pattern, const std::string& file) {
  std::vector<std::size_t> faces;
  const std::string glob(pattern);
  const std::optional<std::size_t> number = number_of(pattern);
  for (std::size_t k = 0; k < design.faces.size(); ++k) {
    const DesignFace& face = design.faces[k];
    const bool meant = number ? *number == k : pattern == "*" || matches(glob, face.name) || matches(glob, face.layer);
    if (meant) faces.push_back(k);
  }
  if (!faces.empty()) return faces;
  throw ToolError(fmt::format("{}: no face is called \"{}\"; `bladefit compile FILE --list` shows its {} faces", file,
                              pattern, design.faces.size()));
}

namespace {

/// Keeps the marked faces, in their order.
void keep_marked(DesignFile& design, const std::vector<bool>& kept) {
  std::vector<NurbsSurface> surfaces;
  std::vector<DesignFace> faces;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (!kept[k]) continue;
    if (surfaces.size() != k) {
      design.warnings.push_back(fmt::format("patch {} is face {}", surfaces.size(), face_title(design, k)));
    }
    surfaces.push_back(std::move(design.surfaces[k]));
    faces.push_back(std::move(design.faces[k]));
  }
  design.surfaces = std::move(surfaces);
  design.faces = std::move(faces);
}

}  // namespace

void keep_numbers(DesignFile& design, const std::vector<std::size_t>& numbers) {
  std::vector<bool> kept(design.faces.size(), false);
  for (const std::size_t number : numbers) kept[number] = true;
  keep_marked(design, kept);
}

void leave_flat_caps(DesignFile& design) {
  double left_out = 0, whole = 0;
  for (const DesignFace& face : design.faces) whole += face.area;
  std::vector<bool> kept;
  for (std::size_t k = 0; k < design.faces.size(); ++k) {
    const DesignFace& face = design.faces[k];
    kept.push_back(face.kind != "plane" || design.surfaces[k].trims.empty());
    if (!kept.back()) left_out += face.area;
  }
  const auto caps = std::ranges::count(kept, false);
  if (caps == 0 || left_out > kLargestCaps * whole) return;
  design.warnings.push_back(fmt::format(
      "left out, {:.1f} % of the area: {} trimmed plane{}, with which a solid model is closed: points there "
      "are beyond the edge of the blade; choose them with --face",
      100 * left_out / whole, caps, caps == 1 ? "" : "s"));
  keep_marked(design, kept);
}

void keep_faces(DesignFile& design, const std::vector<std::string>& patterns, const std::string& file) {
  std::vector<bool> kept(design.faces.size(), false);
  for (const std::string& pattern : patterns) {
    for (const std::size_t k : faces_named(design, pattern, file)) kept[k] = true;
  }
  keep_marked(design, kept);
}

void refuse_missing(const DesignFile& design, const std::string& file) {
  if (design.missing.empty()) return;
  std::string list;
  for (std::size_t k = 0; k < std::min(design.missing.size(), kListed); ++k) {
    list += (k == 0 ? "" : "; ") + design.missing[k];
  }
  if (design.missing.size() > kListed) list += fmt::format("; and {} more", design.missing.size() - kListed);
  throw ToolError(
      fmt::format("{}: {} of {} faces cannot be read: {}; points on them would be judged by others: export "
                  "again, choose faces with --face, or say --allow-missing",
                  file, design.missing.size(), design.missing.size() + design.faces.size(), list));
}

}  // namespace bladefit
