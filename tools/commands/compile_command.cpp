#include "tools/commands/compile_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/fit_text.hpp"
#include "core/geometry/surface/surface.hpp"
#include "tools/commands/design_list.hpp"
#include "tools/commands/design_notes.hpp"
#include "tools/commands/progress_line.hpp"
#include "tools/design/blade_choice.hpp"
#include "tools/design/image/c_array.hpp"
#include "tools/design/image/reach.hpp"
#include "tools/design/load_design.hpp"
#include "tools/design/nurbs/length_unit.hpp"
#include "tools/files/output_file.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

struct CompileOptions {
  std::vector<std::string> designs, faces;
  std::string output, c_array, outward = "auto", axis;
  double blade = 0;  ///< 0: all of the design
  bool list = false, allow_missing = false, compact = false;
};

constexpr const char* kCompileDescription = "Compile the faces of IGES or STEP files into a design image";

constexpr const char* kCompileHelp = R"(
The image (.bfd) is what the localizer works on: Bezier spans, bounding tree, checksum. It is read
without parsing, from a file or from flash, and takes the place of the IGES or STEP file everywhere.
All its lengths are mm; the unit of the design file (mm or inch) is kept for display.

Faces: B-splines are taken as they are, planes, cylinders, cones, spheres, tori, extrusions and
surfaces of revolution become B-splines exactly, offsets and degrees over 9 within 1e-6 of the size
of the design; that is told. A face is cut at the (u, v) box of its trim; a trim inside of the box
becomes loops of straight pieces in (u, v), within 1e-6 of the size of the curves of the file, beyond
which there are no feet. Trimmed planes beside other faces, which close a solid model at root and tip,
are left out, up to a fifth of the area, unless --face names them; that is told. Patches have the numbers of the faces in the file (of faces named PATCH1, PATCH2,
... of a STEP file those), 0 first, so that STEP and IGES of the same system agree. --list shows all.

One blade of a whole propeller: --blade N. Surfaces of revolution about the shaft are the hub; what is
left hangs together in blades, numbered as the right hand turns about the shaft, from that nearest to +y
(+z where the shaft is along y). --list tells them; --axis tells the shaft where the shape does not.

Outward side: which side of the surface is away from the material decides between cut and weld.
  auto  found from the shape where sections close around the material, face by face where the file
        does not say how they look; else from closed shells; else you are asked
  +     the side to which the faces look: of Su x Sv, unless the file says that a face is reversed
  -     the other side
  SUCTION*:+,3:-   a side for each face, by name, pattern or number

Examples:
  bladefit compile fan.igs -o fan.bfd
  bladefit compile sheet.stp -o sheet.bfd --outward -
  bladefit compile propeller.stp --list
  bladefit compile propeller.stp -o blade.bfd --face "BLADE1*" --face 12
  bladefit compile propeller.stp -o blade.bfd --blade 1
  bladefit compile fan.igs -o fan.bfd --compact --c-array fan.c
  bladefit compile suction.igs pressure.igs -o blade.bfd
  bladefit compile fan.igs -o fan.bfd --c-array fan.c     (defines fan_design and fan_design_size)

Exit codes: 0 done, 2 wrong use or bad design, 3 a file cannot be read or written.)";

std::string_view as_text(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// An output must overwrite neither the design nor another output.
void check_outputs(const CompileOptions& options) {
  if (options.c_array == "-") throw ToolError("--c-array -: name a file; the array is named after it");
  for (const std::string& design : options.designs) {
    refuse_overwriting(options.output, "design", design);
    refuse_overwriting(options.c_array, "design", design);
  }
  if (same_file(options.output, options.c_array)) {
    throw ToolError(fmt::format("{}: is both -o and --c-array; give two names", options.output));
  }
}

void write_outputs(const CompileOptions& options, const std::vector<std::byte>& image) {
  OutputFile output(options.output, as_text(image));
  if (options.c_array.empty()) return output.commit();
  const std::string origin = std::filesystem::path(options.designs.front()).filename().string();
  OutputFile array(options.c_array, c_array_source(image, c_array_name(options.c_array), origin));
  array.commit();
  output.commit();
}

void print_patches(std::FILE* words, const DesignImage& image) {
  const auto patches = image.patches();
  fmt::print(words, "  {} patch{}, {} Bezier spans\n", patches.size(), patches.size() == 1 ? "" : "es",
             image.spans().size());
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const ImagePatch& patch = patches[k];
    fmt::print(words, "  patch {}: degree {} x {}, {} x {} spans, {}\n", k, patch.degree_u, patch.degree_v,
               patch.spans_u, patch.spans_v, patch.rational != 0 ? "rational" : "polynomial");
  }
}

void print_box(std::FILE* words, const ImageHeader& header) {
  const auto shown = static_cast<DesignUnit>(header.design_unit);
  const double unit = mm_per_unit(shown);
  fmt::print(words, "  unit of the design: {}\n", shown == DesignUnit::inch ? "inch" : "mm");
  for (int axis = 0; axis < 3; ++axis) {
    fmt::print(words, "  {} {} {:.4f} to {:.4f} {}\n", axis == 0 ? "box:" : "    ", "xyz"[axis],
               header.box_min[axis] / unit, header.box_max[axis] / unit, unit_name(shown));
  }
}

/// How many spans prove feet without a search, and the median of how near these are to be: half of the spans reach
/// farther.
void print_reach(std::FILE* words, const DesignImage& image) {
  const Surface surface(image);
  std::vector<double> outside, inside;
  std::size_t some = 0;
  for (std::uint32_t k = 0; k < image.spans().size(); ++k) {
    const float* reach = image.spans()[k].reach;
    const std::size_t outward = surface.side_of(k) > 0.0 ? 0 : 1;
    outside.push_back(static_cast<double>(reach[outward]));
    inside.push_back(static_cast<double>(reach[1 - outward]));
    if (reach[0] > 0.0F || reach[1] > 0.0F) ++some;
  }
  const auto shown = static_cast<DesignUnit>(image.header().design_unit);
  const auto median = [&](std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle / mm_per_unit(shown);
  };
  fmt::print(words, "  reach: {:.1f} % of the spans; median {:.4g} {} outside, {:.4g} {} inside\n",
             100.0 * static_cast<double>(some) / static_cast<double>(image.spans().size()), median(outside),
             unit_name(shown), median(inside), unit_name(shown));
}

DesignImage open_compiled(const CompileOptions& options, const LoadedDesign& design) {
  DesignImage image;
  if (const Status status = DesignImage::open(design.image, image); status != Status::ok) {
    throw ToolError(fmt::format("{}: the compiled image is not valid ({}); please report this design",
                                options.designs.front(), status_text(status)));
  }
  return image;
}

void print_summary(const CompileOptions& options, const LoadedDesign& design, const DesignImage& image) {
  std::FILE* const words = options.output == "-" ? stderr : stdout;
  fmt::print(words, "{} -> {} ({} bytes)\n", fmt::join(options.designs, " "), options.output, design.image.size());
  if (!options.c_array.empty()) {
    fmt::print(words, "  C array {} in {}\n", c_array_name(options.c_array), options.c_array);
  }
  print_patches(words, image);
  print_box(words, image.header());
  print_reach(words, image);
  tell_notes(design, words, "  ");
}

std::vector<std::filesystem::path> paths_of(const CompileOptions& options) {
  return {options.designs.begin(), options.designs.end()};
}

DesignChoice choice_of(const CompileOptions& options) {
  DesignChoice choice(outward_choice(options.outward), options.faces, options.allow_missing);
  if (options.compact) choice.size = ImageSize::compact;
  if (options.blade != 0) choice.blade = blade_number(options.blade);
  if (options.axis.empty()) return choice;
  ShaftAxis axis;
  if (const Failure error = parse_axis(options.axis, axis)) {
    throw ToolError(fmt::format("--axis {}: {}", options.axis, error.message));
  }
  choice.axis = axis;
  return choice;
}

/// The design with the reach of its spans marked.
LoadedDesign compiled(const CompileOptions& options, const DesignChoice& choice) {
  ProgressLine progress;
  progress.begin("reading the design");
  LoadedDesign design = load_design(paths_of(options), choice);
  progress.begin("proving how far the spans reach");
  mark_reach(design.image, [&progress](std::uint32_t done, std::size_t spans) { progress.count(done, spans); });
  return design;
}

void compile(const CompileOptions& options) {
  if (options.list) {
    fmt::print("{}", design_list(paths_of(options)));
    return;
  }
  if (options.output.empty()) throw ToolError("compile: no output is given; name it with -o, or say --list");
  const DesignChoice choice = choice_of(options);
  check_outputs(options);
  LoadedDesign design = compiled(options, choice);
  const DesignImage image = open_compiled(options, design);
  write_outputs(options, design.image);
  print_summary(options, design, image);
}

}  // namespace

void add_compile_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<CompileOptions>();
  CLI::App* command = app.add_subcommand("compile", kCompileDescription);
  command->footer(kCompileHelp);
  command
      ->add_option("design", options->designs,
                   "IGES or STEP files (.igs .iges .stp .step .p21 .stpz) of one blade, or an image (.bfd); - reads "
                   "standard input")
      ->required()
      ->type_name("DESIGN");
  command->add_option("-o,--output", options->output, "Design image to write; - writes it to standard output")
      ->type_name("OUT.bfd");
  command->add_flag("--list", options->list, "Show the faces of the files and write nothing");
  command
      ->add_option("--face", options->faces, "Face to use: number in --list, name or pattern; repeat it (default all)")
      ->type_name("NAME|N|GLOB")
      ->allow_extra_args(false);
  command
      ->add_option("--blade", options->blade,
                   "Blade of a whole propeller to use: number in --list, about the axis (default all)")
      ->type_name("N")
      ->check(CLI::Range(1.0, 100.0));
  command->add_option("--axis", options->axis, "Shaft about which --blade counts (default that which the shape tells)")
      ->type_name("x|y|z|x0,y0,z0,i,j,k");
  command->add_flag("--allow-missing", options->allow_missing, "Go on without faces that cannot be read");
  command->add_flag(
      "--compact", options->compact,
      "Write an image at most 20 times as large as its control points (default 40), for flash; the same feet, slower");
  command->add_option("--c-array", options->c_array, "Also write the image as a C99 array, for flash")
      ->type_name("OUT.c");
  command->add_option("--outward", options->outward, "Side away from the material (default auto)")
      ->type_name("+|-|auto|FACE:+,FACE:-");
  command->callback([options, &exit_code] {
    compile(*options);
    exit_code = 0;
  });
}

}  // namespace bladefit
