#include "tools/commands/report_record_of.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "tools/commands/commit.hpp"

namespace bladefit {

ReportRecord report_record_of(const ReportIdentity& identity, const FileRoles& files) {
  ReportRecord record;
  record.identity = identity;
  record.begun = utc_now();
  record.version = fmt::format("bladefit {} ({})", BLADEFIT_VERSION, kCommit);
  for (const auto& [role, path] : files) {
    // A pipe can be read once.
    if (std::error_code error; std::filesystem::is_regular_file(path, error))
      record.files.push_back(report_file(role, path));
  }
  return record;
}

ReportRecord resumed(const ReportRecord& before, ReportRecord now) {
  now.begun = before.begun;
  if (now.identity.empty()) now.identity = before.identity;
  return now;
}

}  // namespace bladefit
