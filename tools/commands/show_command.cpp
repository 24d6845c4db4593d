#include "tools/commands/show_command.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/nearest/global_projection.hpp"
#include "drivers/replay/points_csv.hpp"
#include "drivers/text/read_file.hpp"
#include "tools/batch/fit_options.hpp"
#include "tools/batch/tip_radius.hpp"
#include "tools/commands/design_notes.hpp"
#include "tools/commands/fit_flags.hpp"
#include "tools/commands/progress_line.hpp"
#include "tools/files/output_file.hpp"
#include "tools/show/design_page.hpp"

namespace bladefit {
namespace {

struct ShowFlags {
  std::vector<std::string> designs;
  std::string output, points;
  FitSettings settings;
};

/// Of the fit options those that say something of a design and of where points are on it.
constexpr std::array<std::string_view, 13> kShowOptions = {"leading_edge",
                                                           "leading_edge_near",
                                                           "rotation",
                                                           "outward",
                                                           "face",
                                                           "blade",
                                                           "allow_missing",
                                                           "probe_radius",
                                                           "units",
                                                           "columns",
                                                           "ignore_approach",
                                                           "axis",
                                                           "tip_radius"};

constexpr const char* kShowDescription = "Show a design in a web browser, with points and the leading-edge zone on it";

constexpr const char* kShowHelp = R"(
Writes one HTML page that any browser of today opens, from a disk as well, without a network: the design in three
dimensions, to be turned, zoomed and moved with mouse or fingers. On it its faces with their names and patch numbers, lines of constant
u and v with their values, the ridges of greatest curvature, which are leading and trailing edges, the radii r/R about
--axis, and the zone of --leading-edge, or each of the zones of --zones in a colour of its own. A place that is pointed at tells its patch, u, v and r/R, which is what
--leading-edge [PATCH:]u:0.4:0.6 takes. With --points the points stand where they were measured: nothing is fitted.

Examples:
  bladefit show blade.igs -o blade.html
  bladefit show blade.stp -o blade.html --leading-edge u:0.4:0.6 --axis z
  bladefit show suction.igs pressure.igs -o blade.html --points points.csv --units mm

Exit codes: 0 done, 2 wrong use, bad design or bad points, 3 a file cannot be read or written.)";

std::vector<PagePoint> points_on(const Surface& surface, const FitPlan& plan, const std::vector<ProbePoint>& measured) {
  std::vector<PagePoint> points;
  const LocalizerConfig& fit = plan.localizer;
  for (const ProbePoint& probed : measured) {
    ProjectionQuery query{Vec3(probed.position.data()), Vec3::Zero(), 0};
    if (fit.use_approach) query.approach = Vec3(probed.approach.data());
    const SurfacePlace place = project_global(surface, query, nullptr).nearest.place;
    const std::uint32_t patch = surface.span(place.span).patch;
    const SurfacePoint foot = surface.evaluate(place);
    const Vec3 arm = query.point - foot.s;
    const double side = surface.outward(place, foot).dot(arm) < 0.0 ? -1.0 : 1.0;
    const MapPart part = part_at(fit.tolerance, patch, place.u, place.v, foot.s);
    const bool in_zone = part.zone != 0 || part.region == Region::leading_edge;
    points.push_back({points.size(), query.point, patch, place.u, place.v, side * arm.norm() - fit.probe_radius_mm,
                      in_zone, part.zone});
  }
  return points;
}

std::vector<ProbePoint> points_of(const ShowFlags& flags, const FitPlan& plan) {
  if (flags.points.empty()) return {};
  PointsFile file = read_points_csv(flags.points, plan.points);
  if (file.error) throw ToolError(file.error);
  for (const std::string& note : file.notes) fmt::print("{}\n", note);
  return file.points;
}

PageContent content_of(const ShowFlags& flags, const LoadedDesign& loaded, const FitPlan& plan,
                       const Surface& surface) {
  PageContent content;
  for (const std::string& design : flags.designs)
    content.title += (content.title.empty() ? "" : ", ") + std::filesystem::path(design).filename().string();
  content.units = plan.units;
  content.mm_per_unit = plan.mm_per_unit;
  content.axis = plan.axis;
  content.tip_radius_mm = plan.tip_radius_mm > 0.0 ? plan.tip_radius_mm : tip_radius_of(surface, plan.axis);
  content.names = loaded.names;
  for (const PlannedZone& zone : plan.zones) content.zone_names.push_back(zone.name);
  fill_page(surface, plan.localizer.tolerance, content);
  content.points = points_on(surface, plan, points_of(flags, plan));
  return content;
}

void run_show(const ShowFlags& flags) {
  for (const std::string& design : flags.designs) refuse_overwriting(flags.output, "design", design);
  refuse_overwriting(flags.output, "points", flags.points);
  refuse_overwriting(flags.output, "zones", flags.settings.zones_file);
  std::optional<ProgressLine> progress(std::in_place);
  progress->begin("reading the design");
  const LoadedDesign loaded = load_design(
      std::vector<std::filesystem::path>(flags.designs.begin(), flags.designs.end()), design_choice_of(flags.settings));
  progress.reset();
  DesignImage image;
  if (const Status status = DesignImage::open(loaded.image, image); status != Status::ok)
    throw ToolError(fmt::format("{}: {}", flags.designs.front(), status_text(status)));
  const FitPlan plan = plan_fit(flags.settings, image);
  std::FILE* words = flags.output == "-" ? stderr : stdout;
  tell_notes(loaded, words);
  if (!plan.note.empty()) fmt::print(words, "{}", plan.note);
  const PageContent content = content_of(flags, loaded, plan, Surface(image));
  write_output(flags.output, design_page(content));
  for (const std::string& note : content.notes) fmt::print(words, "{}\n", note);
  if (flags.output != "-") fmt::print("Written: {}; open it in a web browser\n", flags.output);
}

}  // namespace

void add_show_command(CLI::App& app, int& exit_code) {
  const auto flags = std::make_shared<ShowFlags>();
  CLI::App* command = app.add_subcommand("show", kShowDescription);
  command->footer(kShowHelp);
  command->add_option("design", flags->designs, "IGES or STEP files of one blade, or an image (.bfd)")
      ->required()
      ->type_name("DESIGN");
  command->add_option("-o,--output", flags->output, "Page to write; - is standard output")
      ->required()
      ->type_name("OUT.html");
  command->add_option("--points", flags->points, "CSV of points to show on the design; - reads standard input")
      ->type_name("POINTS.csv");
  add_fit_options(*command, flags->settings, kShowOptions);
  command->callback([flags, &exit_code] {
    run_show(*flags);
    exit_code = 0;
  });
}

}  // namespace bladefit
