#include "tools/commands/split_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

#include "core/geometry/surface/design_image.hpp"
#include "drivers/replay/points_csv.hpp"
#include "drivers/text/text_number.hpp"
#include "tools/design/load_design.hpp"
#include "tools/design/nurbs/iges_writer.hpp"
#include "tools/design/nurbs/length_unit.hpp"
#include "tools/design/nurbs/patch_points.hpp"
#include "tools/design/read_design.hpp"
#include "tools/files/output_file.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

struct SplitFlags {
  std::string design, output, points, columns, subset;
  std::string outward = "auto";
  std::vector<std::string> cuts;
  double buffer = 0;
};

constexpr const char* kSplitDescription = "Cut the patches of a design exactly, by knot insertion";

constexpr const char* kSplitHelp = R"(
Each --at u:0.33 cuts a patch along the line u = 0.33 (parameters normalised to 0..1, as everywhere in bladefit); several
lines in u and in v make a grid. In a design of several patches say which: --at 2:v:0.5, patches counted from 0. The new
patches are the same surface, each with parameters 0..1; those of the first patch come first, rising in u, then in v.

The buffer keeps points away from the seams and borders, where a foot has no two sides: of each new patch only the part
that is at least B inside it, in the parameters of the uncut patch, is used. With --points and --subset the rows of the
points whose foot as measured lies in these parts are written, one row number a line, for `localize --subset`. The
lengths of the points are in the unit of the design; directions i,j,k in the file choose the side of the blade.

Examples:
  bladefit split fan.igs -o fan3.igs --at u:0.33 --at u:0.66
  bladefit split fan.igs -o fan3.igs --at u:0.33 --at u:0.66 --buffer 0.02 --points points.csv --subset used.txt
  bladefit localize --design fan3.igs --points points.csv --subset used.txt --leading-edge 1:u:0.2:0.8

Exit codes: 0 done, 2 wrong use or bad design, 3 a file cannot be read or written.)";

/// Adds `[PATCH:]u:0.33` to the cuts of its patch.
void add_cut(const std::string& text, std::vector<PatchCuts>& cuts) {
  const auto wrong = [&](const std::string& what) { throw ToolError(fmt::format("--at {}: {}", text, what)); };
  std::size_t place = text.find_first_of("uv");
  std::size_t patch = 0;
  if (place == std::string::npos || place + 1 >= text.size() || text[place + 1] != ':') {
    wrong("say [PATCH:]u:0.33 or [PATCH:]v:0.33");
  }
  if (place == 0 && cuts.size() > 1) {
    wrong(fmt::format("the design has {} patches; say which one is cut, for example 0:{}", cuts.size(), text));
  }
  if (place > 0) {
    const auto number = parse_whole<std::uint32_t>(std::string_view(text).substr(0, place - 1));
    if (text[place - 1] != ':' || !number) wrong("say [PATCH:]u:0.33 or [PATCH:]v:0.33");
    patch = number.value_or(0);
  }
  if (patch >= cuts.size()) wrong(fmt::format("the design has {} patch(es), numbered from 0", cuts.size()));
  const auto at = parse_finite(std::string_view(text).substr(place + 2));
  if (!at || !(*at > 0 && *at < 1)) wrong("the cut must be a number inside 0..1");
  (text[place] == 'u' ? cuts[patch].u : cuts[patch].v).push_back(at.value_or(0));
}

/// Sorts the cuts of each direction and refuses two that are the same.
std::vector<PatchCuts> parse_cuts(const std::vector<std::string>& texts, std::size_t patches) {
  constexpr double kNarrowest = 1e-6;
  std::vector<PatchCuts> cuts(patches);
  for (const std::string& text : texts) add_cut(text, cuts);
  for (PatchCuts& patch : cuts) {
    for (std::vector<double>* along : {&patch.u, &patch.v}) {
      std::sort(along->begin(), along->end());
      double before = 0;
      for (const double at : *along) {
        if (at - before < kNarrowest || 1 - at < kNarrowest) {
          throw ToolError(fmt::format("--at {}: leaves a patch narrower than {}; leave this cut out", at, kNarrowest));
        }
        before = at;
      }
    }
  }
  return cuts;
}

/// The parts of all patches, in the order in which they are written.
std::vector<PatchWindow> parts_of(const std::vector<PatchCuts>& cuts) {
  std::vector<PatchWindow> parts;
  for (std::size_t patch = 0; patch < cuts.size(); ++patch) {
    for (const ParameterRectangle& part : divided(cuts[patch])) {
      parts.push_back({static_cast<std::uint32_t>(patch), part});
    }
  }
  return parts;
}

std::vector<PatchWindow> inside_buffer(std::vector<PatchWindow> parts, double buffer) {
  for (PatchWindow& part : parts) {
    ParameterRectangle& limits = part.limits;
    limits = {limits.u_min + buffer, limits.u_max - buffer, limits.v_min + buffer, limits.v_max - buffer};
    if (limits.u_min < limits.u_max && limits.v_min < limits.v_max) continue;
    throw ToolError(fmt::format("--buffer {}: leaves nothing of a patch; give a smaller one", buffer));
  }
  return parts;
}

/// Rows of the points file that are to be used, and of how many.
struct UsedRows {
  std::vector<std::size_t> rows;
  std::size_t points = 0;
};

UsedRows find_used_rows(const SplitFlags& flags, DesignUnit unit, const std::vector<PatchWindow>& windows) {
  const PointsFile file = read_points_csv(
      flags.points, {unit == DesignUnit::inch ? Unit::inch : Unit::mm, {}, flags.columns, Directions::normalised});
  if (file.error) throw ToolError(file.error);
  for (const std::string& note : file.notes) fmt::print("{}\n", note);
  // Without directions the side of the material plays no part, so that a design that does not tell it will do.
  const OutwardChoice outward = outward_choice(flags.outward);
  const bool either = outward == OutwardOption::automatic && !file.has_approach;
  const LoadedDesign loaded = load_design(flags.design, either ? OutwardChoice(OutwardOption::plus) : outward);
  DesignImage design;
  if (const Status status = DesignImage::open(loaded.image, design); status != Status::ok) {
    throw ToolError(fmt::format("{}: {}", flags.design, status_text(status)));
  }
  UsedRows used{points_inside(design, file.points, windows), file.points.size()};
  if (!used.rows.empty()) return used;
  throw ToolError(
      fmt::format("{}: no foot lies inside the buffer; check units and coordinates of the points", flags.points));
}

void check_flags(const SplitFlags& flags) {
  if (!(flags.buffer >= 0)) throw ToolError(fmt::format("--buffer {}: give a number from 0 on", flags.buffer));
  if (flags.points.empty() != flags.subset.empty()) {
    throw ToolError("--points and --subset belong together: rows of the one are written to the other");
  }
  if (!flags.columns.empty()) {
    if (const Failure failure = check_point_columns(flags.columns)) throw ToolError("--columns: " + failure.message);
  }
  for (const std::string& output : {flags.output, flags.subset}) {
    refuse_overwriting(output, "design", flags.design);
    refuse_overwriting(output, "points", flags.points);
  }
  if (same_file(flags.output, flags.subset)) {
    throw ToolError(fmt::format("{}: is both -o and --subset; give two names", flags.output));
  }
}

std::string limits_text(const ParameterRectangle& limits) {
  return fmt::format("u {:.6g} to {:.6g}, v {:.6g} to {:.6g}", limits.u_min, limits.u_max, limits.v_min, limits.v_max);
}

void print_parts(const std::vector<PatchWindow>& parts, const std::vector<NurbsSurface>& surfaces, double buffer) {
  const std::vector<PatchWindow> windows = inside_buffer(parts, buffer);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    fmt::print("  new patch {}: patch {} from {}; {} x {} control points\n", k, parts[k].patch,
               limits_text(parts[k].limits), surfaces[k].u.control_points, surfaces[k].v.control_points);
    if (buffer > 0) fmt::print("    inside the buffer: {}\n", limits_text(windows[k].limits));
  }
}

/// Writes the points to be used and the design, both or none.
void write_with_subset(const SplitFlags& flags, const std::vector<NurbsSurface>& surfaces, DesignUnit unit,
                       const std::vector<PatchWindow>& windows) {
  const UsedRows used = find_used_rows(flags, unit, windows);
  OutputFile subset(flags.subset, fmt::format("{}\n", fmt::join(used.rows, "\n")));
  write_iges_design(flags.output, surfaces, unit);
  subset.commit();
  fmt::print("{}: {} of {} points lie inside the buffer -> {}\n", flags.points, used.rows.size(), used.points,
             flags.subset);
}

void run_split(const SplitFlags& flags) {
  check_flags(flags);
  const DesignFile design = read_designs({flags.design});
  const std::vector<PatchWindow> parts = parts_of(parse_cuts(flags.cuts, design.surfaces.size()));
  const std::vector<PatchWindow> windows = inside_buffer(parts, flags.buffer);
  std::vector<NurbsSurface> surfaces;
  surfaces.reserve(parts.size());
  for (const PatchWindow& part : parts) surfaces.push_back(part_of(design.surfaces[part.patch], part.limits));
  if (flags.subset.empty()) {
    write_iges_design(flags.output, surfaces, design.unit);
  } else {
    write_with_subset(flags, surfaces, design.unit, windows);
  }
  fmt::print("{} -> {}\n", flags.design, flags.output);
  for (const std::string& warning : design.warnings) fmt::print("  {}\n", warning);
  for (std::size_t k = 0; k < design.surfaces.size(); ++k) {
    if (design.surfaces[k].trims.empty()) continue;
    fmt::print(
        "  patch {} is trimmed: the new file holds all of its surface, beyond the trim too; split it in the CAD "
        "system where that matters\n",
        k);
  }
  print_parts(parts, surfaces, flags.buffer);
}

}  // namespace

void add_split_command(CLI::App& app, int& exit_code) {
  const auto flags = std::make_shared<SplitFlags>();
  CLI::App* command = app.add_subcommand("split", kSplitDescription);
  command->footer(kSplitHelp);
  command->add_option("design", flags->design, "IGES or STEP file (.igs .iges .stp .step)")
      ->required()
      ->type_name("DESIGN");
  command->add_option("-o,--output", flags->output, "IGES file to write")->required()->type_name("OUT.igs");
  command->add_option("--at", flags->cuts, "Cut along this isoparameter line; may be repeated")
      ->required()
      ->allow_extra_args(false)
      ->type_name("[PATCH:]u|v:T");
  command->add_option("--buffer", flags->buffer, "Width of the unused strip inside each new patch")
      ->capture_default_str();
  command->add_option("--points", flags->points, "Measured points (x,y,z[,i,j,k]) to choose from");
  command->add_option("--columns", flags->columns, "What the columns of the points are, as for localize");
  command->add_option("--subset", flags->subset, "Write the row numbers of the points to be used here");
  command->add_option("--outward", flags->outward, "Side away from the material: +, - or auto; for points with i,j,k")
      ->capture_default_str();
  command->callback([flags, &exit_code] {
    run_split(*flags);
    exit_code = 0;
  });
}

}  // namespace bladefit
