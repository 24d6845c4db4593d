#include "tools/commands/sample_command.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <string>

#include "config/fit_settings.hpp"
#include "core/geometry/surface/design_image.hpp"
#include "drivers/text/csv_cells.hpp"
#include "drivers/text/text_number.hpp"
#include "tools/commands/length_flag.hpp"
#include "tools/design/load_design.hpp"
#include "tools/design/nurbs/length_unit.hpp"
#include "tools/design/nurbs/surface_samples.hpp"
#include "tools/files/output_file.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

struct SampleFlags {
  std::string design, output, grid, pose, move, units;
  std::string window = "0:1", along = "u", outward = "auto";
  SamplePlan plan;
  Length offset, noise;
};

constexpr std::uint64_t kMostPoints = 10'000'000;
constexpr std::uint64_t kMostPaths = 65535;

constexpr const char* kSampleDescription = "Take points off a design surface, as a perfect or a noisy machine would";

constexpr const char* kSampleHelp = R"(
Writes x,y,z[,i,j,k],path for `localize`, `run` and `simulate`: a grid of NU x NV points in the parameters of each patch
(or of --patch K), its first and last line at the limits of --window. A path is a line of constant v, or of constant u
with --along v. Lengths are in the unit of the design unless --units is given, angles in radians.

  --offset D   points stand D outside the surface: excess material, or the centres of a ball of radius D
  --noise S    and normally distributed by S along the normal, the same for the same --seed
  --normals    columns i,j,k: the probe comes in against the outward normal
  --pose P     puts the blade so on the machine that `localize` finds the pose P = tx,ty,tz,psi,theta,phi of its
               result.json: r = C R + t gives the design's point r for each point R written
  --move P     moves the points by P itself: R = C r + t

A check of a fit from end to end, which must find the pose -0.5,0.3,0.2,0.01,-0.02,0.005 again:
  bladefit sample blade.igs -o points.csv --grid 40x20 --window 0.05:0.95 --pose -0.5,0.3,0.2,0.01,-0.02,0.005
  bladefit localize --design blade.igs --points points.csv --json result.json

Exit codes: 0 done, 2 wrong use or bad design, 3 a file cannot be read or written.)";

[[noreturn]] void fail(const char* option, const std::string& text, const std::string& fix) {
  throw ToolError(fmt::format("{} {}: {}", option, text, fix));
}

void parse_grid(const SampleFlags& flags, SamplePlan& plan) {
  const std::size_t cross = flags.grid.find('x');
  const std::string_view text = flags.grid;
  const auto count_u = parse_whole<std::uint32_t>(text.substr(0, cross));
  const auto count_v = parse_whole<std::uint32_t>(cross == std::string::npos ? "" : text.substr(cross + 1));
  if (!count_u || !count_v || *count_u == 0 || *count_v == 0) {
    fail("--grid", flags.grid, "say how many points in u and in v, for example 40x20");
  }
  plan.count_u = *count_u;
  plan.count_v = *count_v;
}

/// tx,ty,tz,psi,theta,phi; lengths times `mm`.
Pose parse_pose(const char* option, const std::string& text, double mm) {
  std::vector<std::string_view> cells;
  static_cast<void>(split_cells(text, ',', cells));
  std::array<double, 6> numbers{};
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto number = cells.size() == numbers.size() ? parse_finite(cells[k]) : std::nullopt;
    if (!number) fail(option, text, "give six numbers tx,ty,tz,psi,theta,phi, angles in radians");
    numbers[k] = *number;
  }
  Pose pose;
  pose.rotation = rotation_of({numbers[3], numbers[4], numbers[5]});
  pose.translation = mm * Vec3(numbers[0], numbers[1], numbers[2]);
  return pose;
}

Pose inverse(const Pose& pose) {
  Pose result;
  result.rotation = pose.rotation.transpose();
  result.translation = -(result.rotation * pose.translation);
  return result;
}

DesignUnit unit_of(const SampleFlags& flags, const DesignImage& design) {
  if (flags.units == "mm") return DesignUnit::mm;
  if (flags.units == "in") return DesignUnit::inch;
  return static_cast<DesignUnit>(design.header().design_unit);
}

void check_plan(const SampleFlags& flags, const SamplePlan& plan, const DesignImage& design) {
  const auto patches = static_cast<std::uint64_t>(design.patches().size());
  if (plan.patch && *plan.patch >= patches) {
    fail("--patch", std::to_string(*plan.patch), fmt::format("the design has {} patch(es), numbered from 0", patches));
  }
  const std::uint64_t grids = plan.patch ? 1 : patches;
  const std::uint64_t lines = grids * (plan.lines_along_v ? plan.count_u : plan.count_v);
  const std::uint64_t points = grids * plan.count_u * plan.count_v;
  if (lines > kMostPaths || points > kMostPoints) {
    fail("--grid", flags.grid,
         fmt::format("{} points on {} paths, at most {} on {} are possible; make it coarser", points, lines,
                     kMostPoints, kMostPaths));
  }
  if (!(flags.noise.value >= 0)) fail("--noise", fmt::format("{}", flags.noise.value), "give a length from 0 on");
}

SamplePlan plan_samples(const SampleFlags& flags, const DesignImage& design) {
  SamplePlan plan = flags.plan;
  const double mm = mm_per_unit(unit_of(flags, design));
  parse_grid(flags, plan);
  ParameterWindow window;
  if (const Failure error = parse_window(flags.window, window)) fail("--window", flags.window, error.message);
  plan.low = window.low;
  plan.high = window.high;
  plan.lines_along_v = flags.along == "v";
  plan.offset_mm = flags.offset.in_mm(mm);
  plan.noise_mm = flags.noise.in_mm(mm);
  if (!flags.pose.empty() && !flags.move.empty()) throw ToolError("--pose and --move: give one of them, not both");
  if (!flags.pose.empty()) plan.pose = inverse(parse_pose("--pose", flags.pose, mm));
  if (!flags.move.empty()) plan.pose = parse_pose("--move", flags.move, mm);
  check_plan(flags, plan, design);
  return plan;
}

std::string points_text(const std::vector<ProbePoint>& points, bool directions, double mm) {
  std::string text = directions ? "x,y,z,i,j,k,path\n" : "x,y,z,path\n";
  const auto out = std::back_inserter(text);
  for (const ProbePoint& point : points) {
    for (const double coordinate : point.position) fmt::format_to(out, "{},", coordinate / mm);
    if (directions) fmt::format_to(out, "{},{},{},", point.approach[0], point.approach[1], point.approach[2]);
    fmt::format_to(out, "{}\n", point.path);
  }
  return text;
}

void run_sample(const SampleFlags& flags) {
  refuse_overwriting(flags.output, "design", flags.design);
  // The side of the material plays a part only where something stands off the surface or looks at it.
  const OutwardChoice asked = outward_choice(flags.outward);
  const bool either = asked == OutwardOption::automatic && flags.offset.value == 0 && !flags.plan.directions;
  const bool stored = lower_extension(flags.design) == ".bfd";
  const LoadedDesign loaded = load_design(flags.design, either && !stored ? OutwardChoice(OutwardOption::plus) : asked);
  DesignImage design;
  if (const Status status = DesignImage::open(loaded.image, design); status != Status::ok) {
    throw ToolError(fmt::format("{}: {}", flags.design, status_text(status)));
  }
  const SamplePlan plan = plan_samples(flags, design);
  const std::vector<ProbePoint> points = sample_surface(design, plan);
  const DesignUnit unit = unit_of(flags, design);
  write_output(flags.output, points_text(points, plan.directions, mm_per_unit(unit)));
  if (flags.output == "-") return;
  fmt::print("{} -> {}\n  {} points on {} paths, in {}\n", flags.design, flags.output, points.size(),
             points.back().path, unit == DesignUnit::inch ? "inches" : "mm");
}

void add_measuring_flags(CLI::App& command, SampleFlags& flags) {
  command.add_flag("--normals", flags.plan.directions, "Add the columns i,j,k");
  add_length_flag(
      command, "--offset", [&flags](const Length& length) { flags.offset = length; },
      "Distance of the points from the surface (default 0)");
  add_length_flag(
      command, "--noise", [&flags](const Length& length) { flags.noise = length; },
      "Standard deviation along the normal (default 0)");
  command.add_option("--seed", flags.plan.seed, "Seed of the noise")->capture_default_str();
  command.add_option("--pose", flags.pose, "The pose that localize is to find")->type_name("TX,TY,TZ,PSI,THETA,PHI");
  command.add_option("--move", flags.move, "A motion of the points")->type_name("TX,TY,TZ,PSI,THETA,PHI");
}

}  // namespace

void add_sample_command(CLI::App& app, int& exit_code) {
  const auto flags = std::make_shared<SampleFlags>();
  CLI::App* command = app.add_subcommand("sample", kSampleDescription);
  command->footer(kSampleHelp);
  command->add_option("design", flags->design, "IGES or STEP file, or an image (.bfd)")
      ->required()
      ->type_name("DESIGN");
  command->add_option("-o,--output", flags->output, "CSV to write; - is standard output")
      ->required()
      ->type_name("POINTS.csv");
  command->add_option("--grid", flags->grid, "Points in u and in v on each patch")->required()->type_name("NUxNV");
  command->add_option("--window", flags->window, "Limits of the parameters of the grid")->capture_default_str();
  command->add_option("--patch", flags->plan.patch, "Number of the only patch, counted from 0 (default: all)");
  command->add_option("--along", flags->along, "Direction of the paths: u or v")
      ->check(CLI::IsMember({"u", "v"}))
      ->capture_default_str();
  add_measuring_flags(*command, *flags);
  command->add_option("--units", flags->units, "Unit of lengths: mm or in (default: that of the design)")
      ->check(CLI::IsMember({"mm", "in"}));
  command->add_option("--outward", flags->outward, "Side away from the material: +, - or auto")->capture_default_str();
  command->callback([flags, &exit_code] {
    run_sample(*flags);
    exit_code = 0;
  });
}

}  // namespace bladefit
