#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/source/failure.hpp"
#include "tools/results/result.hpp"

namespace bladefit {

/// What became of files that were to be written.
struct WrittenFiles {
  std::vector<std::string> paths;  ///< of those that were
  std::vector<Failure> failures;   ///< a line each of those that were not
};

/// Writes verdicts.csv, result.json and, where the result has a record, report.json into the session folder, each as a
/// whole or not at all, and whatever becomes of the other.
[[nodiscard]] WrittenFiles write_session_files(const std::string& directory, const Result& result);

/// Writes the record, and the image of the design that the session is judged by. Throws ToolError (device).
void write_session_record(const std::string& directory, const ReportRecord& record);
void write_session_design(const std::string& directory, std::span<const std::byte> image);

/// The record of a session; nothing where its folder has none. Throws ToolError that names file and field.
[[nodiscard]] std::optional<ReportRecord> read_session_record(const std::string& directory);

/// The image of the design that a session was judged by; empty where its folder has none, as after earlier versions.
/// Throws ToolError where it is another design than that of `identity`.
[[nodiscard]] std::vector<std::byte> read_session_design(const std::string& directory, const SessionIdentity& identity);

/// Adds `path` to the files, or why `write` could not write it.
void add_written(const std::string& path, const std::function<void()>& write, WrittenFiles& files);

/// Removes what killed runs left of a session's files, and returns the names.
[[nodiscard]] std::vector<std::string> remove_stray_session_files(const std::string& directory);

/// Reads result.json and verdicts.csv of a session folder, with its record and settings where they are there, and
/// checks that they are whole, belong together and tell of every point in the journal. Throws ToolError (bad_input)
/// that names the file and the fix, also where the session still runs or was cut off.
[[nodiscard]] Result read_session(const std::string& directory);

}  // namespace bladefit
