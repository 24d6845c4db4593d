#include "tools/design/load_design.hpp"

#include <fmt/format.h>

#include <span>

#include "core/geometry/surface/design_image.hpp"
#include "tools/design/blade_choice.hpp"
#include "tools/design/choose_sides.hpp"
#include "tools/design/design_doubts.hpp"
#include "tools/design/design_input.hpp"
#include "tools/design/face_choice.hpp"
#include "tools/design/image/image_writer.hpp"
#include "tools/design/nurbs/length_unit.hpp"
#include "tools/design/read_design.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

std::string side_note(int sign, const std::string& reason) {
  return fmt::format("outward side: {} ({}): {}", sign > 0 ? "+" : "-",
                     sign > 0 ? "to which the faces look" : "opposite to where the faces look", reason);
}

LoadedDesign load_image(const std::filesystem::path& path, const DesignChoice& choice) {
  if (choice.size == ImageSize::compact) {
    throw ToolError(fmt::format("{}: is compiled already; --compact needs the IGES or STEP file", path.string()));
  }
  if (!choice.faces.empty() || choice.blade || !choice.outward.faces.empty()) {
    throw ToolError(
        fmt::format("{}: a compiled design has no names of faces; choose faces, blade and sides when it is "
                    "compiled",
                    path.string()));
  }
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
  if (choice.outward.all == OutwardOption::automatic) {
    design.notes.push_back(side_note(stored, "as stored in the image"));
    return design;
  }
  const int sign = choice.outward.all == OutwardOption::plus ? 1 : -1;
  set_outward(design.image, sign);
  design.notes.push_back(
      side_note(sign, sign == stored ? "as asked and as stored" : "as asked; the image had the other one"));
  return design;
}

void choose_faces(DesignFile& design, const DesignChoice& choice, const std::string& file) {
  if (!choice.faces.empty() && choice.blade) {
    throw ToolError("--face and --blade: both choose faces of the design; leave one out");
  }
  if (!choice.faces.empty()) return keep_faces(design, choice.faces, file);
  if (!choice.allow_missing) refuse_missing(design, file);
  if (!choice.blade) return;
  std::optional<ShaftAxis> axis = choice.axis;
  if (axis) axis->point *= choice.mm_per_unit.value_or(mm_per_unit(design.unit));
  keep_blade(design, *choice.blade, axis, file);
}

}  // namespace

OutwardChoice outward_choice(std::string_view text) {
  OutwardChoice choice;
  if (const Failure error = parse_outward(text, choice)) {
    throw ToolError(fmt::format("--outward {}: {}", text, error.message));
  }
  return choice;
}

DesignFile read_designs(const std::vector<std::filesystem::path>& names) {
  const DesignInput input(names);
  const std::vector<std::filesystem::path>& paths = input.paths();
  DesignFile design = read_design(paths.front());
  for (std::size_t k = 1; k < paths.size(); ++k) {
    DesignFile other = read_design(paths[k]);
    if (other.unit != design.unit) {
      throw ToolError(fmt::format("{}: is in {}, but {} in {}; export both in one unit", paths[k].string(),
                                  unit_name(other.unit), paths.front().string(), unit_name(design.unit)));
    }
    if (other.file_unit_mm != design.file_unit_mm) {
      design.warnings.push_back(fmt::format("{}: its unit is {:g} mm, that of {} {:g} mm: is one of them wrong?",
                                            paths[k].string(), other.file_unit_mm, paths.front().string(),
                                            design.file_unit_mm));
    }
    const auto append = [](auto& to, auto& from) {
      to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
    };
    append(design.surfaces, other.surfaces);
    append(design.faces, other.faces);
    append(design.warnings, other.warnings);
    append(design.missing, other.missing);
  }
  return design;
}

LoadedDesign load_design(const std::filesystem::path& path, const DesignChoice& choice) {
  return load_design(std::vector{path}, choice);
}

LoadedDesign load_design(const std::vector<std::filesystem::path>& names, const DesignChoice& choice) {
  const DesignInput input(names);
  const std::vector<std::filesystem::path>& paths = input.paths();
  const std::string file = paths.front().string();
  if (paths.size() == 1 && lower_extension(paths.front()) == ".bfd") return load_image(paths.front(), choice);
  DesignFile design = read_designs(paths);
  choose_faces(design, choice, file);
  if (choice.faces.empty()) leave_flat_caps(design);
  if (design.surfaces.empty()) throw ToolError(fmt::format("{}: no face that can be read is left", file));
  const OutwardSide side = choose_sides(design, choice.outward, file);
  LoadedDesign loaded{write_image(design.surfaces, design.unit, side.sign, choice.size),
                      design.warnings,
                      trim_warning(design, file),
                      {}};
  for (const DesignFace& face : design.faces) loaded.names.push_back(face.name);
  const std::vector<std::string> doubts = design_doubts(design);
  loaded.notes.insert(loaded.notes.end(), doubts.begin(), doubts.end());
  if (std::string note = trim_note(design); !note.empty()) loaded.notes.push_back(std::move(note));
  loaded.notes.push_back(side_note(side.sign, side.reason));
  return loaded;
}

}  // namespace bladefit
