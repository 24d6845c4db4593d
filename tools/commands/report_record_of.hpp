#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tools/results/report_record.hpp"

namespace bladefit {

/// Roles with the paths of files that a result rests on.
using FileRoles = std::vector<std::pair<std::string, std::string>>;

/// The record of a measurement that begins now, by this version. Files without a name and standard input are left out.
/// Throws ToolError where one cannot be read. Cost: reads all of them.
[[nodiscard]] ReportRecord report_record_of(const ReportIdentity& identity, const FileRoles& files);

/// The record of a session that goes on from `before`: it began then, and keeps its identity where `now` has none.
[[nodiscard]] ReportRecord resumed(const ReportRecord& before, ReportRecord now);

}  // namespace bladefit
