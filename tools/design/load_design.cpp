#include "tools/design/load_design.hpp"

#include <fmt/format.h>

#include <span>

#include "core/geometry/surface/design_image.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/nurbs/outward_side.hpp"
#include "tools/design/occ/face_trim.hpp"
#include "tools/design/read_design.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

std::string side_note(int sign, const std::string& reason) {
  return fmt::format("outward side: {} (Su x Sv {}): {}", sign > 0 ? "+" : "-", sign > 0 ? "as it is" : "reversed",
                     reason);
}

LoadedDesign load_image(const std::filesystem::path& path, OutwardOption outward) {
  const std::string bytes = read_text(path);
  LoadedDesign design;
  const auto content = std::as_bytes(std::span(bytes));
  design.image.assign(content.begin(), content.end());
  DesignImage view;
  if (const Status status = DesignImage::open(design.image, view); status != Status::ok) {
    throw ToolError(
        fmt::format("{}: not a usable design image: {}", path.string(),
                    design.image.empty() ? "the file is empty: compile the design again" : status_text(status)));
  }
  const int stored = view.header().outward;
  if (outward == OutwardOption::automatic) {
    design.notes.push_back(side_note(stored, "as stored in the image"));
    return design;
  }
  const int sign = outward == OutwardOption::plus ? 1 : -1;
  set_outward(design.image, sign);
  design.notes.push_back(
      side_note(sign, sign == stored ? "as asked and as stored" : "as asked; the image had the other one"));
  return design;
}

OutwardSide choose_side(const DesignFile& file, const std::string& name, OutwardOption outward) {
  if (outward == OutwardOption::automatic) return find_outward_side(file.surfaces, name);
  return {outward == OutwardOption::plus ? 1 : -1, "as asked"};
}

}  // namespace

OutwardOption parse_outward(std::string_view text) {
  for (std::size_t k = 0; k < kOutwardWords.size(); ++k) {
    if (text == kOutwardWords[k]) return static_cast<OutwardOption>(k);
  }
  throw ToolError(fmt::format("--outward {}: unknown side; say +, - or auto", text));
}

LoadedDesign load_design(const std::filesystem::path& path, OutwardOption outward) {
  if (lower_extension(path) == ".bfd") return load_image(path, outward);
  const DesignFile file = read_design(path);
  const OutwardSide side = choose_side(file, path.string(), outward);
  LoadedDesign design{write_image(file.surfaces, file.unit, side.sign), file.warnings,
                      trim_warning(path.string(), file.trimmed)};
  design.notes.push_back(side_note(side.sign, side.reason));
  return design;
}

}  // namespace bladefit
