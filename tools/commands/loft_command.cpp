#include "tools/commands/loft_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "tools/design/iges/iges_writer.hpp"
#include "tools/design/loft/loft.hpp"
#include "tools/design/nurbs/length_unit.hpp"
#include "tools/files/output_file.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

struct LoftFlags {
  std::string sections, output, units;
  LoftSettings settings;
};

constexpr const char* kLoftDescription =
    "Loft a design surface from the measured or tabulated points of blade sections";

constexpr const char* kLoftHelp = R"(
SECTIONS.csv names its columns in the first line: section,x,y,z and, if there, index and r_over_R. The rows of a section
stand together, its points in their order along the section (trailing edge, one side, leading edge, other side, trailing
edge); the sections go from root to tip. Sections may have different numbers of points.

  v  runs along the sections. Each becomes a least-squares spline over its chord length through its first and its last
     point, all with the same knots: uniform ones, or those of --knots. More control points follow the points closer,
     and their noise as well. Default: a third of the points of the shortest section as knots (180 points: 60 knots).
  u  runs over the sections: splines through their control points, section k of n at u = k/(n-1).

What is printed: how far the points are from the surface, root mean square and largest.

Examples:
  bladefit loft sections.csv -o blade.igs --units in
  bladefit loft sections.csv -o blade.igs --units mm --control-points 80
  bladefit loft sections.csv -o blade.igs --units mm --knots 0.2,0.4,0.46,0.5,0.54,0.6,0.8    (dense at the leading edge)

Exit codes: 0 done, 2 wrong use or bad sections, 3 a file cannot be read or written.)";

void print_deviation(const BladeSections& sections, const LoftDeviation& deviation, DesignUnit unit) {
  const double mm = mm_per_unit(unit);
  const BladeSection& worst = sections.sections[deviation.section];
  fmt::print("  points off the surface: RMS {:.3g} {}, at most {:.3g} {} in section {}{} at line {}\n",
             deviation.rms_mm / mm, unit_name(unit), deviation.largest_mm / mm, unit_name(unit), worst.name,
             worst.radius ? fmt::format(" (r/R {})", *worst.radius) : "", worst.lines[deviation.point]);
}

void run_loft(const LoftFlags& flags) {
  refuse_overwriting(flags.output, "sections", flags.sections);
  const DesignUnit unit = flags.units == "in" ? DesignUnit::inch : DesignUnit::mm;
  const BladeSections sections = read_sections_csv(flags.sections);
  const NurbsSurface surface = loft(sections, flags.settings, mm_per_unit(unit));
  const LoftDeviation deviation = loft_deviation(surface, sections, mm_per_unit(unit));
  write_iges_design(flags.output, {surface}, unit);
  fmt::print("{} -> {}\n", flags.sections, flags.output);
  fmt::print("  {} sections, {} points\n", sections.sections.size(), deviation.points);
  fmt::print("  u over the sections: degree {}, {} control points\n", surface.u.degree, surface.u.control_points);
  fmt::print("  v along the sections: degree {}, {} control points\n", surface.v.degree, surface.v.control_points);
  print_deviation(sections, deviation, unit);
}

}  // namespace

void add_loft_command(CLI::App& app, int& exit_code) {
  const auto flags = std::make_shared<LoftFlags>();
  LoftSettings& settings = flags->settings;
  CLI::App* command = app.add_subcommand("loft", kLoftDescription);
  command->footer(kLoftHelp);
  command->add_option("sections", flags->sections, "CSV with the points of the sections")
      ->required()
      ->type_name("SECTIONS.csv");
  command->add_option("-o,--output", flags->output, "IGES file to write")->required()->type_name("OUT.igs");
  command->add_option("--units", flags->units, "Unit of the sections and of the IGES file: mm or in")
      ->required()
      ->check(CLI::IsMember({"mm", "in"}));
  command->add_option("--control-points", settings.control_points, "Control points along a section, knots uniform");
  command->add_option("--knots", settings.knots, "Internal knots along a section, between 0 and 1, rising")
      ->delimiter(',')
      ->type_name("T1,T2,...");
  command->add_option("--degree", settings.degree, "Degree along the sections")->capture_default_str();
  command->add_option("--span-degree", settings.span_degree, "Degree over the sections")->capture_default_str();
  command->callback([flags, &exit_code] {
    run_loft(*flags);
    exit_code = 0;
  });
}

}  // namespace bladefit
