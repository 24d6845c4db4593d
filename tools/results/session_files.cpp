#include "tools/results/session_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/geometry/surface/design_image.hpp"
#include "drivers/text/read_file.hpp"
#include "firmware_bridge/host/journal/journal_reader.hpp"
#include "firmware_bridge/host/journal/session_file_names.hpp"
#include "firmware_bridge/host/journal/session_settings_file.hpp"
#include "tools/files/output_file.hpp"
#include "tools/files/tool_error.hpp"
#include "tools/results/json_reader.hpp"
#include "tools/results/json_writer.hpp"
#include "tools/results/verdicts_csv.hpp"
#include "tools/results/words.hpp"

namespace bladefit {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFileSize = std::size_t{1} << 29U;

void check_directory(const std::string& directory) {
  std::error_code error;
  if (fs::is_directory(directory, error)) return;
  throw ToolError(fmt::format("{}: {}; give the folder that `bladefit run --session` wrote", directory,
                              fs::exists(directory, error) ? "is not a folder" : "there is no such folder"));
}

JournalContent read_recording(const fs::path& folder) {
  JournalContent journal;
  if (const Failure error = read_journal(folder / kJournalFile, journal)) throw ToolError(error.message);
  if (journal.exists) return journal;
  throw ToolError(fmt::format("{}: holds no {} of a session; give the folder that `bladefit run --session` wrote",
                              folder.string(), kJournalFile));
}

bool is_finite(const std::array<double, 3>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
}

/// The localizer refuses the other points, so that they have no verdict.
bool is_usable(const StreamEvent& event) {
  return event.kind == EventKind::point && is_finite(event.point.position) && is_finite(event.point.approach);
}

/// The text of a file that need not be there.
std::optional<std::string> read_if_there(const fs::path& path) {
  if (std::error_code error; !fs::exists(path, error)) return std::nullopt;
  std::string text;
  if (const Failure failure = read_file(path, kMaxFileSize, text))
    throw ToolError(fmt::format("{}: {}", path.string(), failure.message), failure.kind);
  return text;
}

std::string read_part(const fs::path& folder, const char* name, const JournalContent& journal) {
  const fs::path path = folder / name;
  if (std::error_code error; !fs::exists(path, error)) {
    const auto points = std::count_if(journal.events.begin(), journal.events.end(), is_usable);
    throw ToolError(
        fmt::format("{}: is missing: the session still runs or was cut off ({} points are recorded); wait for its end, "
                    "or run it again with the same --session",
                    path.string(), points));
  }
  return *read_if_there(path);
}

void check_same_run(const std::string& directory, const Rows<ResultPoint>& result, const Rows<ResultPoint>& points) {
  const bool same = std::equal(
      result.begin(), result.end(), points.begin(), points.end(),
      [](const ResultPoint& a, const ResultPoint& b) { return a.sequence == b.sequence && a.state == b.state; });
  if (same) return;
  throw ToolError(
      fmt::format("{}: {} ({} points) and {} ({} points) are not of one run; run the session again with the same "
                  "--session",
                  directory, kResultFile, result.size(), kVerdictsFile, points.size()));
}

/// A point's zone is one of the result.
void check_zones(const std::string& directory, const Result& result, const Rows<ResultPoint>& points) {
  const auto known = [&result](const ResultPoint& point) { return point.zone <= result.zones.size(); };
  if (std::all_of(points.begin(), points.end(), known)) return;
  throw ToolError(fmt::format("{}: {} names a zone that {} has not; {}", directory, kVerdictsFile, kResultFile,
                              kDamagedFileRemedy));
}

/// Sequence of the newest point that has a verdict when the session ends; 0 = none.
std::uint32_t newest_point(const JournalContent& journal) {
  for (auto event = journal.events.rbegin(); event != journal.events.rend(); ++event) {
    if (event->kind == EventKind::reset) return 0;
    if (is_usable(*event)) return event->point.sequence;
  }
  return 0;
}

/// A session that was resumed leaves the result of its earlier part until it ends.
void check_up_to_date(const std::string& directory, const JournalContent& journal, const Rows<ResultPoint>& points) {
  const std::uint32_t recorded = newest_point(journal);
  const std::uint32_t judged = points.empty() ? 0 : points.back().sequence;
  if (recorded == judged) return;
  throw ToolError(
      fmt::format("{}: {} ends with point {}, the recording with point {}: the session was resumed and still runs or "
                  "was cut off; wait for its end, or run it again with the same --session",
                  directory, kResultFile, judged, recorded));
}

}  // namespace

void add_written(const std::string& path, const std::function<void()>& write, WrittenFiles& files) {
  try {
    write();
    files.paths.push_back(path);
  } catch (const ToolError& error) {
    files.failures.push_back({error.kind(), error.what()});
  }
}

WrittenFiles write_session_files(const std::string& directory, const Result& result) {
  const fs::path folder(directory);
  const auto write = [&folder](const char* name, const TextWriter& text) { OutputFile(folder / name, text).commit(); };
  WrittenFiles files;
  add_written(
      folder / kResultFile, [&] { write(kResultFile, [&result](const Put& put) { write_result_json(result, put); }); },
      files);
  add_written(
      folder / kVerdictsFile,
      [&] { write(kVerdictsFile, [&result](const Put& put) { write_verdicts_csv(result.points, put); }); }, files);
  if (result.record) {
    add_written(
        folder / kRecordFile, [&] { write_session_record(directory, *result.record); }, files);
  }
  return files;
}

void write_session_record(const std::string& directory, const ReportRecord& record) {
  OutputFile(fs::path(directory) / kRecordFile, record_json(record)).commit();
}

void write_session_design(const std::string& directory, std::span<const std::byte> image) {
  const std::string_view bytes(reinterpret_cast<const char*>(image.data()), image.size());
  OutputFile(fs::path(directory) / kDesignFile, bytes).commit();
}

std::optional<ReportRecord> read_session_record(const std::string& directory) {
  const fs::path path = fs::path(directory) / kRecordFile;
  const std::optional<std::string> text = read_if_there(path);
  if (!text) return std::nullopt;
  return parse_record(path, *text);
}

std::vector<std::byte> read_session_design(const std::string& directory, const SessionIdentity& identity) {
  const fs::path path = fs::path(directory) / kDesignFile;
  const std::optional<std::string> text = read_if_there(path);
  if (!text) return {};
  const auto* const bytes = reinterpret_cast<const std::byte*>(text->data());
  std::vector<std::byte> image(bytes, bytes + text->size());
  DesignImage design;
  const bool valid = DesignImage::open(image, design) == Status::ok;
  if (valid && design.identity() == identity.design_crc) return image;
  throw ToolError(
      fmt::format("{}: {}; run the session again with the same --session, or remove the file: the report is "
                  "then without pictures of the blade",
                  path.string(), valid ? "is another design than the one the session was judged by" : "is damaged"));
}

std::vector<std::string> remove_stray_session_files(const std::string& directory) {
  std::vector<std::string> removed;
  for (const char* const name : {kResultFile, kVerdictsFile, kRecordFile, kDesignFile}) {
    const std::vector<std::string> parts = remove_stray_parts(fs::path(directory) / name);
    removed.insert(removed.end(), parts.begin(), parts.end());
  }
  return removed;
}

Result read_session(const std::string& directory) {
  check_directory(directory);
  const fs::path folder(directory);
  const JournalContent journal = read_recording(folder);
  const std::string text = read_part(folder, kResultFile, journal);
  const std::string verdicts = read_part(folder, kVerdictsFile, journal);
  Result result = parse_result(folder / kResultFile, text);
  Rows<ResultPoint> points = parse_verdicts(folder / kVerdictsFile, verdicts);
  check_same_run(directory, result.points, points);
  check_zones(directory, result, points);
  check_up_to_date(directory, journal, points);
  result.name = fs::weakly_canonical(folder).filename().string();
  result.identity = journal.identity;
  result.points = std::move(points);
  result.record = read_session_record(directory);
  if (const auto settings = read_if_there(folder / kSettingsFile)) result.settings = named_settings(*settings);
  return result;
}

}  // namespace bladefit
