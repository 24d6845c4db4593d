#include "tools/commands/doctor_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "config/device_settings.hpp"
#include "config/table_reader.hpp"
#include "drivers/source_uri.hpp"
#include "tools/batch/fit_options.hpp"
#include "tools/commands/session_source.hpp"
#include "tools/doctor/examine_device.hpp"
#include "tools/files/exit_codes.hpp"
#include "tools/files/message.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr double kShortestTime_s = 1, kLongestTime_s = 600;

struct DoctorFlags {
  std::string config, source, design;
  double timeout_s = 15;
};

/// A session file, or a device file alone: that one has a `kind`.
SessionSettings examined_session(const DoctorFlags& flags) {
  SessionSettings session;
  if (!flags.config.empty()) {
    const TomlDocument document = read_toml(flags.config);
    if (document.error) throw ToolError(document.error);
    if (document.root.contains("kind")) {
      session.device = flags.config;
    } else if (const Failure error = load_session(flags.config, session)) {
      throw ToolError(error);
    }
  }
  if (!flags.source.empty()) session.source = flags.source;
  if (!flags.design.empty()) session.design = flags.design;
  return session;
}

/// A design with the memory it lies in.
struct OpenDesign {
  LoadedDesign loaded;
  DesignImage image;
  std::optional<PlacedDesign> placed;
};

/// Opens the design of the session and places it where the fit would start. Nothing where the session names none.
void open_design(const SessionSettings& session, OpenDesign& design) {
  if (!session.design) return;
  design.loaded = load_design(*session.design, design_choice_of(session.fit));
  if (const Status status = DesignImage::open(design.loaded.image, design.image); status != Status::ok)
    throw ToolError(fmt::format("{}: {}", *session.design, status_text(status)));
  const FitPlan plan = plan_fit(session.fit, design.image);
  design.placed = PlacedDesign{Surface(design.image), plan.localizer.start, plan.localizer.probe_radius_mm};
}

int exit_code_of_outcome(Outcome outcome) {
  switch (outcome) {
    case Outcome::fits:
      return 0;
    case Outcome::change:
      return kBadInput;
    case Outcome::unreachable:
      return kDeviceFailure;
    case Outcome::undecided:
      break;
  }
  return kNotDecided;
}

int examine(const DoctorFlags& flags) {
  if (!(flags.timeout_s >= kShortestTime_s && flags.timeout_s <= kLongestTime_s)) {
    throw ToolError(
        fmt::format("--timeout {}: give {} to {} seconds", flags.timeout_s, kShortestTime_s, kLongestTime_s));
  }
  const SessionSettings session = examined_session(flags);
  const SourceSettings source = source_of(session);
  OpenDesign design;
  open_design(session, design);
  const std::string name = source_name(source);
  if (!std::holds_alternative<ModbusSettings>(source))
    tell(fmt::format("{}: listening for up to {} s", name, flags.timeout_s));
  const Deadline until = std::chrono::steady_clock::now() +
                         std::chrono::duration_cast<Deadline::duration>(std::chrono::duration<double>(flags.timeout_s));
  const Examination examination = examine_device(source, design.placed ? &*design.placed : nullptr, until);
  fmt::print("{}: {}\n", name, examination.conclusion);
  for (const std::string& line : examination.seen) fmt::print("  {}\n", line);
  return exit_code_of_outcome(examination.outcome);
}

}  // namespace

void add_doctor_command(CLI::App& app, int& exit_code) {
  const auto flags = std::make_shared<DoctorFlags>();
  CLI::App* command =
      app.add_subcommand("doctor", "check a configuration against the real device, and say which setting is wrong");
  command->footer(
      "\nNothing is written to the device: no point is acknowledged, no session started or stopped. A register map is "
      "read\n"
      "with the other word order, byte order, table, unit and addresses one off too, lines with other rates and "
      "formats; with\n"
      "a design the points are tried with scales of 0.001, 1/25.4, 25.4 and 1000. Exit codes: 0 it fits, 2 a setting "
      "is to\n"
      "be changed, 3 the device does not answer, 4 not decided: the first line says why.\n"
      "Examples:\n"
      "  bladefit doctor --config session.toml\n"
      "  bladefit doctor --config machine.toml --design blade.bfd --timeout 30");
  command->add_option("--config", flags->config, "session TOML, as for run, or a device TOML (see config/devices)");
  command->add_option("--source", flags->source,
                      "where the machine is: a source as for run, but no recording; wins over the files");
  command->add_option(
      "--design", flags->design,
      "design that the points are held against: .igs .iges .stp .step, or .bfd; wins over the session's");
  command->add_option("--timeout", flags->timeout_s, "seconds that it may take, 1 to 600")->capture_default_str();
  command->callback([flags, &exit_code] { exit_code = examine(*flags); });
}

}  // namespace bladefit
