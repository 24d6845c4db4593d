#include "tools/commands/simulate_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "config/fit_option.hpp"
#include "core/geometry/surface/design_image.hpp"
#include "drivers/text/units.hpp"
#include "tools/design/load_design.hpp"
#include "tools/design/read_design.hpp"
#include "tools/files/output_file.hpp"
#include "tools/files/read_text.hpp"
#include "tools/files/tool_error.hpp"
#include "tools/simulate/simulator.hpp"
#include "tools/simulate/transports.hpp"

namespace bladefit {
namespace {

/// The flags as they are given, before the units are known.
struct SimulateFlags {
  SimulatorSettings settings;
  std::string design;
  std::string units;
};

void add_source_flags(CLI::App& command, SimulateFlags& flags) {
  SimulatorSettings& settings = flags.settings;
  command
      .add_option("--points", settings.points,
                  "CSV of the points that the machine touches: x,y,z[,i,j,k][,path][,weight]")
      ->required();
  command.add_option("--design", flags.design, "design file; read for the units of the points only");
  command.add_option("--units", flags.units,
                     "units of the points: mm, in, cm or m (default: those of the design, else mm)");
  command.add_option("--columns", settings.points_format.columns,
                     "what the columns of the points are, as for localize");
  command.add_option("--rate", settings.rate, "points a second; 0 = as fast as they are acknowledged")
      ->capture_default_str();
  command.add_option("--capacity", settings.capacity, "records that the machine's ring holds")->capture_default_str();
  command.add_option("--run-id", settings.run_id, "number of the run that the machine tells")->capture_default_str();
}

void add_transport_flags(CLI::App& command, SimulateFlags& flags) {
  SimulatorSettings& settings = flags.settings;
  command.add_option("--transport", settings.transport, "how readers reach the machine")
      ->required()
      ->check(CLI::IsMember(simulate::transport_words()));
  command.add_option("--port", settings.port, "Modbus TCP port on 127.0.0.1; 0 = any free one, which is printed")
      ->capture_default_str();
  command.add_option("--device", settings.device,
                     "Modbus RTU and serial: make this a link to the pseudo terminal (default: print its own name)");
  command.add_option("--unit", settings.unit, "Modbus RTU: address of the machine on the line")->capture_default_str();
  command.add_option("--map-version", settings.map_version, "map version that the machine claims, to test readers")
      ->capture_default_str();
}

void add_test_flags(CLI::App& command, SimulatorSettings& settings) {
  command.add_option(
      "--faults", settings.faults,
      "faults as NAME=PROBABILITY per record (serial) or per reply (Modbus), for example "
      "drop=0.01,duplicate=0.02,corrupt=0.01,delay=0.05:200ms,disconnect=0.001,seed=7; the word overflow "
      "lets the machine lose its oldest records instead of waiting for the reader");
  command.add_option("--seed", settings.seed, "seed of the faults (default 1)");
  command.add_option("--stamp", settings.stamps,
                     "write sequence,nanoseconds (CLOCK_MONOTONIC) of the moment each record became readable");
  command.add_flag("--exit-when-done", settings.exit_when_done, "end when the last record was acknowledged");
  command.add_flag("--verbose", settings.verbose, "tell commands and faults on standard error");
}

/// The unit of a design. A CAD file is read for it, but not compiled.
DesignUnit design_unit(const std::string& path) {
  if (lower_extension(path) != ".bfd") return read_design(path).unit;
  const LoadedDesign design = load_design(path, OutwardOption::automatic);
  DesignImage image;
  const Status status = DesignImage::open(design.image, image);
  if (!succeeded(status)) throw ToolError(fmt::format("{}: {}", path, status_text(status)));
  return static_cast<DesignUnit>(image.header().design_unit);
}

/// How the points file is to be read. Throws ToolError for a design that cannot be read.
void plan_points(SimulateFlags& flags) {
  PointsFormat& format = flags.settings.points_format;
  if (!format.columns.empty()) {
    if (const Failure failure = check_point_columns(format.columns)) throw ToolError("--columns: " + failure.message);
  }
  if (!flags.units.empty()) {
    std::size_t unit = 0;
    if (const Failure failure = find_word(kUnitWords, flags.units, unit))
      throw ToolError("--units: " + failure.message);
    format.given_unit = static_cast<Unit>(unit);
  } else if (!flags.design.empty() && design_unit(flags.design) == DesignUnit::inch) {
    format.unit = Unit::inch;
  }
}

int serve_points(SimulateFlags& flags) {
  refuse_overwriting(flags.settings.stamps, "points", flags.settings.points);
  refuse_overwriting(flags.settings.stamps, "design", flags.design);
  plan_points(flags);
  return run_simulator(flags.settings);
}

}  // namespace

void add_simulate_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("simulate", "a simulated CMM that serves the points of a file");
  command->footer(
      "\nExamples:\n"
      "  bladefit simulate --points points.csv --transport modbus-tcp --port 1502 --rate 200\n"
      "  bladefit simulate --points points.csv --transport serial --device /tmp/machine");
  const auto flags = std::make_shared<SimulateFlags>();
  add_source_flags(*command, *flags);
  add_transport_flags(*command, *flags);
  add_test_flags(*command, flags->settings);
  command->callback([flags, &exit_code] { exit_code = serve_points(*flags); });
}

}  // namespace bladefit
