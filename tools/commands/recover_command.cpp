#include "tools/commands/recover_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "firmware_bridge/host/journal/journal.hpp"
#include "firmware_bridge/host/journal/journal_reader.hpp"
#include "firmware_bridge/host/journal/journal_salvage.hpp"
#include "firmware_bridge/host/journal/session_file_names.hpp"
#include "firmware_bridge/host/journal/session_folder.hpp"
#include "tools/files/exit_codes.hpp"
#include "tools/files/output_file.hpp"
#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr const char* kRecoverHelp = R"(
Examples:
  bladefit recover monday                      # says what is whole and what is lost; writes nothing
  bladefit recover monday -o points.csv        # the points, in mm, for localize or run --source replay:points.csv
  bladefit recover monday -o monday-2          # a session that run --session monday-2 goes on with
In a session the lost points stay known, so that the blade is not decided before they are probed again; a CSV file says
them in its first lines only.

Exit codes: 0 every record is whole, 2 wrong use or nothing to recover, 3 a file cannot be read or written, 4 records are
lost: the ranges are told.)";

struct RecoverFlags {
  std::string session, output;
};

std::string range(const char* what, std::uint32_t first, std::uint32_t last) {
  if (first == last) return fmt::format("{} {}", what, first);
  return fmt::format("{}s {} to {}", what, first, last);
}

/// What is missing where records are damaged: "records 17 to 20: points 17 to 20 are lost; probe them again".
std::string loss_line(const DamagedRecords& damaged) {
  const std::uint32_t records = damaged.last - damaged.first + 1;
  const std::string place = range("record", damaged.first, damaged.last);
  if (damaged.point_after == 0) {
    return fmt::format("{}: whatever came after point {} is lost, {} at most; probe it again", place,
                       damaged.point_before, range("record", 1, records));
  }
  const std::uint32_t points = damaged.point_after - damaged.point_before - 1;
  const std::string lost = points == 0 ? "no point is lost"
                                       : fmt::format("{} lost; probe again",
                                                     range("point", damaged.point_before + 1, damaged.point_after - 1));
  const bool marks = records > points;
  return fmt::format("{}: {}{}", place, lost, marks ? "; marks of resets or of the program's end may be lost too" : "");
}

std::vector<std::string> losses_of(const Salvage& salvage) {
  std::vector<std::string> lines;
  for (const DamagedRecords& damaged : salvage.damaged) lines.push_back(loss_line(damaged));
  if (salvage.damaged.empty() && salvage.torn_bytes > 0) {
    lines.push_back(
        fmt::format("{} bytes at the end are no whole record: it was never completed, or the file was cut; the device "
                    "still holds what was not stored",
                    salvage.torn_bytes));
  }
  return lines;
}

/// The points that were not forgotten by a reset.
std::vector<ProbePoint> points_of(const Salvage& salvage) {
  std::vector<ProbePoint> points;
  for (const StreamEvent& event : salvage.events) {
    if (event.kind == EventKind::reset) points.clear();
    if (event.kind == EventKind::point) points.push_back(event.point);
  }
  return points;
}

void write_points(const std::string& path, const std::vector<ProbePoint>& points,
                  const std::vector<std::string>& losses) {
  write_output(path, [&](const Put& put) {
    for (const std::string& loss : losses) put(fmt::format("# {}\n", loss));
    put("x,y,z,i,j,k,path,weight\n");
    for (const ProbePoint& point : points) {
      put(fmt::format("{},{},{},{},{},{},{},{}\n", point.position[0], point.position[1], point.position[2],
                      point.approach[0], point.approach[1], point.approach[2], point.path, point.weight));
    }
  });
}

void throw_if(const Failure& failure) {
  if (failure) throw ToolError(failure);
}

/// A journal of the whole records in a folder of its own, with the settings beside it.
void write_session(const std::string& from, const std::string& to, const Salvage& salvage) {
  if (same_file(from, to)) throw ToolError(fmt::format("{}: is the damaged session itself; name a new folder", to));
  if (!salvage.header_whole) {
    throw ToolError(fmt::format(
        "{}: the header is damaged, so that design, settings and run are not known; save the points with -o "
        "points.csv",
        (std::filesystem::path(from) / kJournalFile).string()));
  }
  SessionFolder folder;
  throw_if(folder.make(to));
  const std::string path = (std::filesystem::path(to) / kJournalFile).string();
  Journal journal;
  throw_if(journal.open(path));
  JournalReader there;
  throw_if(there.open(journal.descriptor(), path));
  if (there.summary().exists) {
    throw ToolError(fmt::format("{}: holds a session already; name a new folder", to));
  }
  throw_if(journal.start(salvage.identity, salvage.run_id));
  for (std::size_t first = 0; first < salvage.events.size(); first += kJournalGroup) {
    const std::size_t count = std::min(kJournalGroup, salvage.events.size() - first);
    throw_if(journal.append(std::span(salvage.events).subspan(first, count)));
  }
  std::error_code none;
  std::filesystem::copy_file(std::filesystem::path(from) / kSettingsFile, std::filesystem::path(to) / kSettingsFile,
                             none);
}

void write_recovered(const RecoverFlags& flags, const Salvage& salvage, const std::vector<ProbePoint>& points,
                     const std::vector<std::string>& losses) {
  if (flags.output.empty()) return;
  const bool csv = flags.output == "-" || std::filesystem::path(flags.output).extension() == ".csv";
  for (const char* const name : {kJournalFile, kSettingsFile, kVerdictsFile, kResultFile})
    refuse_overwriting(flags.output == "-" ? "" : flags.output, "session", std::filesystem::path(flags.session) / name);
  if (csv) {
    write_points(flags.output, points, losses);
  } else {
    write_session(flags.session, flags.output, salvage);
  }
  if (flags.output != "-") fmt::print("Written: {}\n", flags.output);
}

int recover(const RecoverFlags& flags) {
  std::FILE* const words = flags.output == "-" ? stderr : stdout;
  const std::string path = (std::filesystem::path(flags.session) / kJournalFile).string();
  Salvage salvage;
  throw_if(salvage_journal(path, salvage));
  const std::vector<ProbePoint> points = points_of(salvage);
  if (salvage.events.empty()) {
    throw ToolError(fmt::format(
        "{}: no record of {} is whole: nothing can be recovered; copy the file from a backup, or probe again", path,
        salvage.records));
  }
  const std::vector<std::string> losses = losses_of(salvage);
  fmt::print(words, "{}: {} of {} records are whole, with {} points; the header is {}\n", path, salvage.events.size(),
             salvage.records, points.size(), salvage.header_whole ? "whole" : "damaged");
  for (const std::string& loss : losses) fmt::print(words, "Lost: {}\n", loss);
  write_recovered(flags, salvage, points, losses);
  return losses.empty() && salvage.header_whole ? 0 : kNotDecided;
}

}  // namespace

void add_recover_command(CLI::App& app, int& exit_code) {
  const auto flags = std::make_shared<RecoverFlags>();
  CLI::App* command = app.add_subcommand("recover", "save the good records of a damaged session");
  command->footer(kRecoverHelp);
  command->add_option("session", flags->session, "folder that `bladefit run --session` wrote")
      ->required()
      ->type_name("SESSION_DIR");
  command
      ->add_option("-o,--output", flags->output,
                   "points as .csv (- for standard output), or the folder of a new session")
      ->type_name("OUT");
  command->callback([flags, &exit_code] { exit_code = recover(*flags); });
}

}  // namespace bladefit
