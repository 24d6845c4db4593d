#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "config/report_identity.hpp"

namespace bladefit {

/// A file that a result rests on.
struct ReportFile {
  std::string role, path;  ///< "design", as it was given
  std::uint64_t size = 0;  ///< bytes
  std::string sha256;      ///< 64 hexadecimal digits

  [[nodiscard]] bool operator==(const ReportFile&) const = default;
};

/// What a report says of the measurement beside its result: the session's file report.json.
struct ReportRecord {
  ReportIdentity identity;
  std::string begun, ended;  ///< UTC as utc_now() writes it; empty = not known
  std::string version;       ///< of the program that judged
  std::vector<ReportFile> files;
};

/// The present time, "2026-11-28 08:41:12 UTC".
[[nodiscard]] std::string utc_now();

/// The file with its size and checksum. Throws ToolError as read_text() does. Cost: reads the whole file.
[[nodiscard]] ReportFile report_file(const std::string& role, const std::string& path);

[[nodiscard]] std::string record_json(const ReportRecord& record);

/// Reads what record_json() wrote to the file `path`. Throws ToolError that names file and field.
[[nodiscard]] ReportRecord parse_record(const std::string& path, const std::string& text);

}  // namespace bladefit
