#include "tools/commands/loft_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/fit_text.hpp"
#include "tools/commands/length_flag.hpp"
#include "tools/design/loft/blade_table.hpp"
#include "tools/design/loft/leading_edge.hpp"
#include "tools/design/loft/loft.hpp"
#include "tools/design/nurbs/iges_writer.hpp"
#include "tools/design/nurbs/length_unit.hpp"
#include "tools/files/output_file.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

/// A surface farther from its points than this share of the leading-edge tolerance would show in every verdict; where
/// no tolerance is known, than this length [mm].
constexpr double kShareOfTolerance = 0.1, kLargestOff_mm = 0.1;
/// What a zone about the leading edge takes on either side of it [v].
constexpr double kZone = 0.05;

struct LoftFlags {
  std::string sections, table, output, units, foil = std::string(kFoilWords[0]), hand = std::string(kRotationWords[0]);
  std::optional<Length> diameter, tolerance;
  LoftSettings settings;
};

constexpr const char* kLoftDescription =
    "Loft a design surface from the points of blade sections or from a propeller's table";

constexpr const char* kLoftHelp = R"(
SECTIONS.csv names its columns in the first line: section,x,y,z and, if there, index and r_over_R. The rows of a section
stand together, its points in their order along the section (trailing edge, one side, leading edge, other side, trailing
edge); the sections go from root to tip. Sections may have different numbers of points.

  v  runs along the sections. Each becomes a least-squares spline over its chord length through its first and its last
     point, all with the same knots: uniform ones, or those of --knots. More control points follow the points closer,
     and their noise as well. Default: a third of the points of the shortest section as knots (180 points: 60 knots).
  u  runs over the sections: splines through their control points, section k of n at u = k/(n-1).

What is printed: how far the points are from the surface, root mean square and largest, and where the leading edge lies
in v. A surface that is farther from its points than a tenth of --tolerance (0.1 mm where it is not given) is written, with
a warning: distances from it are wrong by as much. --follow-points makes the knots dense where the points are, which on
sections with dense points at the leading edge keeps the surface near them there.

With --table there are no points: BLADE.csv is a propeller's table with the columns r_over_R, c_over_D, P_over_D, f_over_c,
t_over_c (or t_over_D) and, if there, skew [degrees] and rake_over_D, a row a radius from root to tip. --diameter is D.
  --section naca66  NACA 66 with the modified nose and tail of DTMB, mean line a = 0.8 (default)
  --section naca16  NACA 16, mean line a = 1
Thickness is laid off at right angles to the nose-tail line. Skew is that of the middle of the chord along the helix, positive
towards the trailing edge; rake is that of the generator line, positive aft, without what skew adds to it. x is the axis
of the shaft, forward; z the generator line. Only radii from the first to the last row are made.

Examples:
  bladefit loft --table blade.csv --diameter 304.8 -o blade.igs --units mm
  bladefit loft sections.csv -o blade.igs --units in
  bladefit loft sections.csv -o blade.igs --units mm --control-points 80
  bladefit loft sections.csv -o blade.igs --units mm --follow-points --tolerance 0.1
  bladefit loft sections.csv -o blade.igs --units mm --knots 0.2,0.4,0.46,0.5,0.54,0.6,0.8    (dense at the leading edge)

Exit codes: 0 done, 2 wrong use or bad sections, 3 a file cannot be read or written.)";

void print_deviation(const BladeSections& sections, const LoftDeviation& deviation, DesignUnit unit) {
  const double mm = mm_per_unit(unit);
  const BladeSection& worst = sections.sections[deviation.section];
  const bool named = !worst.lines.empty() && worst.radius;
  fmt::print("  points off the surface: RMS {:.3g} {}, at most {:.3g} {} in section {}{}{}\n", deviation.rms_mm / mm,
             unit_name(unit), deviation.largest_mm / mm, unit_name(unit), worst.name,
             named ? fmt::format(" (r/R {})", *worst.radius) : "",
             worst.lines.empty() ? "" : fmt::format(" at line {}", worst.lines[deviation.point]));
}

/// The zone to judge it by, for --leading-edge.
void print_leading_edge(const BladeSections& sections) {
  const std::optional<LeadingEdgeRange> edge = leading_edge_of(sections);
  if (!edge) {
    fmt::print("  leading edge: not found, since the sections do not begin and end at one trailing edge\n");
    return;
  }
  fmt::print(
      "  leading edge, opposite the ends of the sections: v {:.4f} to {:.4f}, as --leading-edge v:{:.2f}:{:.2f}\n",
      edge->v_min, edge->v_max, std::max(0.0, edge->v_min - kZone), std::min(1.0, edge->v_max + kZone));
}

/// Of a surface that is not where its points are.
void warn_of_deviation(const LoftFlags& flags, const BladeSections& sections, const LoftDeviation& deviation,
                       double mm) {
  const double most = flags.tolerance ? kShareOfTolerance * flags.tolerance->in_mm(mm) : kLargestOff_mm;
  if (deviation.largest_mm <= most) return;
  const BladeSection& worst = sections.sections[deviation.section];
  const std::string place = worst.lines.empty() ? "" : fmt::format(":{}", worst.lines[deviation.point]);
  fmt::print(
      stderr,
      "bladefit: warning: {}{}: the surface is {:.3g} {} off a point of section {} there, more than {:.3g} {}; give "
      "--follow-points, more --control-points, or --knots that are dense there\n",
      sections.file, place, deviation.largest_mm / mm, flags.units, worst.name, most / mm, flags.units);
}

const Length& above_zero(const char* flag, const Length& length) {
  if (!(length.value > 0)) throw ToolError(fmt::format("{} {}: give a length above 0", flag, length.value));
  return length;
}

/// The sections of a propeller's table.
BladeSections tabulated(const LoftFlags& flags) {
  if (!flags.diameter) throw ToolError("--table: the diameter is not given; add --diameter, in --units");
  const BladeTable table = parse_blade_table(read_text(flags.table), flags.table);
  BladeShape shape{.diameter = flags.diameter->in_units(flags.units == "in" ? kMmPerInch : 1.0)};
  shape.foil = flags.foil == kFoilWords[0] ? Foil::naca66 : Foil::naca16;
  shape.left_handed = flags.hand == kRotationWords[static_cast<std::size_t>(Rotation::left)];
  return sections_of(table, shape);
}

BladeSections read_sections(const LoftFlags& flags) {
  if (flags.sections.empty() == flags.table.empty()) {
    throw ToolError(flags.table.empty() ? "loft: neither SECTIONS.csv nor --table is given; name one"
                                        : "loft: SECTIONS.csv and --table are both given; leave one out");
  }
  if (!flags.table.empty()) return tabulated(flags);
  if (flags.diameter) throw ToolError("--diameter: is for --table alone; leave it out");
  return read_sections_csv(flags.sections);
}

void run_loft(const LoftFlags& flags) {
  const std::string& input = flags.table.empty() ? flags.sections : flags.table;
  refuse_overwriting(flags.output, flags.table.empty() ? "sections" : "table", input);
  const DesignUnit unit = flags.units == "in" ? DesignUnit::inch : DesignUnit::mm;
  const BladeSections sections = read_sections(flags);
  if (sections.unit && mm_per_unit(*sections.unit) != mm_per_unit(unit)) {
    throw ToolError(fmt::format("{}: the file gives its lengths in {}, but --units says {}; correct one of the two",
                                flags.sections, word_of(*sections.unit), flags.units));
  }
  LoftSettings settings = flags.settings;
  // The points of a table's sections are dense where they bend, and have no noise.
  settings.follow_points = settings.follow_points || (!flags.table.empty() && settings.knots.empty());
  settings.knots_at_sections = !flags.table.empty();
  const NurbsSurface surface = loft(sections, settings, mm_per_unit(unit));
  const LoftDeviation deviation = loft_deviation(surface, sections, mm_per_unit(unit));
  write_iges_design(flags.output, {surface}, unit);
  fmt::print("{} -> {}\n", input, flags.output);
  if (!sections.note.empty()) fmt::print("  {}\n", sections.note);
  fmt::print("  {} sections, {} points\n", sections.sections.size(), deviation.points);
  fmt::print("  u over the sections: degree {}, {} control points\n", surface.u.degree, surface.u.control_points);
  fmt::print("  v along the sections: degree {}, {} control points\n", surface.v.degree, surface.v.control_points);
  print_deviation(sections, deviation, unit);
  print_leading_edge(sections);
  warn_of_deviation(flags, sections, deviation, mm_per_unit(unit));
}

}  // namespace

void add_loft_command(CLI::App& app, int& exit_code) {
  const auto flags = std::make_shared<LoftFlags>();
  LoftSettings& settings = flags->settings;
  CLI::App* command = app.add_subcommand("loft", kLoftDescription);
  command->footer(kLoftHelp);
  command->add_option("sections", flags->sections, "CSV with the points of the sections")->type_name("SECTIONS.csv");
  command->add_option("--table", flags->table, "CSV with a propeller's table, in place of sections")
      ->type_name("BLADE.csv");
  add_length_flag(
      *command, "--diameter", [flags](const Length& length) { flags->diameter = above_zero("--diameter", length); },
      "Diameter of the propeller of --table, in --units");
  command->add_option("--section", flags->foil, "Sections of --table: naca66 (modified, a = 0.8) or naca16 (a = 1)")
      ->check(CLI::IsMember(std::vector<std::string>(kFoilWords.begin(), kFoilWords.end())))
      ->capture_default_str();
  command->add_option("--hand", flags->hand, "Which way the propeller of --table turns, seen from aft: right or left")
      ->check(CLI::IsMember(std::vector<std::string>(kRotationWords.begin(), kRotationWords.end())))
      ->capture_default_str();
  command->add_option("-o,--output", flags->output, "IGES file to write")->required()->type_name("OUT.igs");
  command->add_option("--units", flags->units, "Unit of the sections and of the IGES file: mm or in")
      ->required()
      ->check(CLI::IsMember({"mm", "in"}));
  command->add_option("--control-points", settings.control_points, "Control points along a section, knots uniform");
  command->add_option("--knots", settings.knots, "Internal knots along a section, between 0 and 1, rising")
      ->delimiter(',')
      ->type_name("T1,T2,...");
  command->add_flag("--follow-points", settings.follow_points,
                    "Knots along a section that are dense where its points are, in place of uniform ones");
  add_length_flag(
      *command, "--tolerance", [flags](const Length& length) { flags->tolerance = above_zero("--tolerance", length); },
      "Leading-edge tolerance that the blade will be judged by");
  command->add_option("--degree", settings.degree, "Degree along the sections")->capture_default_str();
  command->add_option("--span-degree", settings.span_degree, "Degree over the sections")->capture_default_str();
  command->callback([flags, &exit_code] {
    run_loft(*flags);
    exit_code = 0;
  });
}

}  // namespace bladefit
